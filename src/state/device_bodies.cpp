// Uploads and downloads model and state.
#include "state/device_bodies.hpp"

#include <algorithm>
#include <iterator>

namespace pliant {
namespace {

physics::Body body_of(const ModelBody& body, double strain_bias) {
  const double unit = body.unit_of_length();
  return {.inverse_unit = 1 / unit,
          .unit_force = body.unit_force() / (1 + strain_bias),
          .inverse_mass = 1 / body.vertex_mass,
          .damping = body.damping,
          .first_vertex = body.first_vertex,
          .vertex_count = body.vertex_count};
}

std::vector<physics::Body> bodies_of(const Model& model, double strain_bias) {
  std::vector<physics::Body> bodies;
  for (const ModelBody& body : model.bodies) bodies.push_back(body_of(body, strain_bias));
  return bodies;
}

// Whether the body moves from the start, whatever touches it later. An undeformed one has one displacement.
bool moves(const Model& model, const State& state, std::size_t b) {
  const ModelBody& body = model.bodies[b];
  if (body.is_rigid()) return false;
  if (body.inflation.pressure != 0 || std::ranges::any_of(state.poses[b].gravity, [](double g) { return g != 0; })) return true;
  const glm::dvec3 displacement = state.displacement(body.first_vertex);
  for (std::uint32_t i = body.first_vertex; i < body.first_vertex + body.vertex_count; ++i)
    if (state.velocity(i) != glm::dvec3(0.0) || state.displacement(i) != displacement) return true;
  return false;
}

std::vector<ForceBody> force_bodies_of(const Model& model, const State& state) {
  std::vector<ForceBody> bodies;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    bodies.push_back(
        {model.bodies[b].vertex_count, !model.bodies[b].is_rigid(), moves(model, state, b), model.bodies[b].is_clustered});
  return bodies;
}

// Which bodies move from the start is forgotten, so all count as moving. That matters for bodies of one dispatch alone.
std::vector<ForceBody> later_force_bodies_of(const Model& model, const std::vector<bool>& have_given_sums) {
  std::vector<ForceBody> bodies;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    bodies.push_back(
        {model.bodies[b].vertex_count, !model.bodies[b].is_rigid(), !model.bodies[b].is_rigid(), have_given_sums[b]});
  return bodies;
}

ForceAbilities abilities_of(const Device& device) {
  return {device.force_variants(), device.shares_at_once(), device.variant_for_given_sums()};
}

// Other passes sum the springs of clustered bodies.
std::vector<std::size_t> variants_with(const Device& device, const Model& model, std::size_t force_variant) {
  std::vector<std::size_t> variants;
  for (const ModelBody& body : model.bodies)
    variants.push_back(body.is_clustered ? device.force_variants().size() : force_variant);
  return variants;
}

void add_shares(const Model& model, std::uint32_t b, std::uint32_t share_size, double strain_bias,
                std::vector<physics::Share>& shares) {
  const ModelBody& body = model.bodies[b];
  for (std::uint32_t first = 0; first < body.vertex_count; first += std::min(share_size, body.vertex_count - first))
    shares.push_back({.body = body_of(body, strain_bias),
                      .body_index = b,
                      .first_vertex = body.first_vertex + first,
                      .vertex_count = std::min(share_size, body.vertex_count - first),
                      .tableau_row = 0});
}

std::vector<physics::Share> shares_of(Device& device, const Model& model, const std::vector<std::size_t>& variants,
                                      std::span<const ForceGroup> groups) {
  std::vector<physics::Share> shares;
  const ForceAbilities abilities = abilities_of(device);
  for (const ForceGroup& group : groups)
    for (std::uint32_t b = 0; b < model.bodies.size(); ++b)
      if (!model.bodies[b].is_rigid() && variants[b] == group.variant)
        add_shares(model, b, abilities.variant(group.variant).share_size, device.strain_bias(), shares);
  return shares;
}

std::vector<glm::vec4> rounded_world_positions(const Model& model, const State& state) {
  std::vector<glm::vec4> rounded;
  for (const glm::dvec3& position : state.world_positions(model)) rounded.emplace_back(glm::vec3(position), 1.0f);
  return rounded;
}

physics::BoxBits empty_box() {
  physics::BoxBits box{};
  std::fill_n(box.lower, 3, ~0u);
  return box;
}

std::uint32_t activity_of(BodyKind kind) {
  if (kind == BodyKind::scripted) return physics::scripted;
  return kind == BodyKind::immovable ? physics::immovable : physics::moving;
}

physics::Status first_status(BodyKind kind) {
  return {.activity = activity_of(kind),
          .non_finite_vertex = physics::no_vertex,
          .deformed = 0,
          .force_stale = 1,
          .calm = 0,
          .partner_step = 0,
          .first_pair = 0,
          .slow_for = 0,
          .pressed_by_static = 0,
          .falls_asleep = 0,
          .asleep = 0,
          .disturbed = 0,
          .folds = 0,
          .steps_to_star = 0};
}

std::vector<physics::Status> first_statuses(const Model& model) {
  std::vector<physics::Status> statuses;
  for (const ModelBody& body : model.bodies) statuses.push_back(first_status(body.kind));
  statuses.push_back(first_status(BodyKind::soft));  // stands for all
  return statuses;
}

physics::Control first_control() {
  physics::Control control{};
  control.step = 1;
  control.non_finite_vertex = physics::no_vertex;
  return control;
}

}  // namespace

DeviceBodies::DeviceBodies(Device& device, const Model& model, const State& state)
    : DeviceBodies(device, model, state, choose_force_variants(abilities_of(device), force_bodies_of(model, state))) {}

DeviceBodies::DeviceBodies(Device& device, const Model& model, const State& state, std::size_t force_variant)
    : DeviceBodies(device, model, state, variants_with(device, model, force_variant)) {}

DeviceBodies::DeviceBodies(Device& device, const Model& model, const State& state, const std::vector<std::size_t>& variants)
    : vertex_count(model.vertex_count()),
      body_count(static_cast<std::uint32_t>(model.bodies.size())),
      force_variants(variants),
      force_groups(group_shares(abilities_of(device), force_bodies_of(model, state), variants)),
      arrays(device),
      poses(arrays.make("pose", state.poses)),
      statuses(arrays.make("status", first_statuses(model))),
      tallies(arrays.make<physics::Tally>("tally", body_count)),
      motions(arrays.make<double>("motion", std::size_t{2} * physics::motion_size * vertex_count)),
      world_positions(arrays.make<glm::vec4>("world_position", std::size_t{2} * vertex_count)),
      control(arrays.make("control", std::vector{first_control()})) {
  arrays.set_parameter("vertex_count", vertex_count);
  arrays.set_parameter("body_count", body_count);
  arrays.set_parameter("parts_of", 0.0);
  arrays.set_parameter("skips", physics::skips_forces | physics::skips_rest);
  arrays.make("share", shares_of(device, model, variants, force_groups));
  arrays.make<physics::FrameChange>("frame_change", body_count);
  arrays.make("body_box", std::vector(body_count, empty_box()));
  arrays.make("place_box", std::vector(body_count, empty_box()));
  arrays.make<std::uint32_t>("meeting", body_count);
  arrays.make<double>("slept", std::size_t{4} * body_count);
  arrays.make("body", bodies_of(model, device.strain_bias()));
  arrays.make("rest_position", model.rest_positions);
  const std::vector<glm::vec4> positions = rounded_world_positions(model, state);
  for (std::uint32_t half = 0; half < 2; ++half) {  // static bodies stay as they are in both
    motions.upload(state.motion, physics::displacement_of(first_of_half(half)));
    world_positions.upload(positions, first_of_half(half));
  }
  if (std::ranges::any_of(model.bodies, [](const ModelBody& body) { return body.path.has_value(); })) make_paths(model, state);
}

void DeviceBodies::make_paths(const Model& model, const State& start) {
  std::vector<physics::Path> paths;
  std::vector<physics::PathKey> keys;
  std::vector<physics::PathState> states;
  for (const ModelBody& body : model.bodies) {
    physics::PathState& state = states.emplace_back();
    state.time = start.path_times.empty() ? 0 : start.path_times[states.size() - 1];
    state.pace = 1;
    if (body.path) state.now = body.path->at(state.time);
    physics::Path& way = paths.emplace_back();
    if (!body.path) continue;
    way = body.path->way;
    way.first_key = static_cast<std::uint32_t>(keys.size());
    std::ranges::copy(body.path->keys, std::back_inserter(keys));
  }
  arrays.make("path", paths);
  arrays.make("path_key", keys);
  path_states = &arrays.make("path_state", states);
}

void DeviceBodies::run_all_stages(bool at_once) {
  const ForceAbilities device = abilities_of(arrays.device());
  for (ForceGroup& group : force_groups) group.all_stages = at_once && device.variant(group.variant).all_stages;
}

// Only the slot of the step's start is carried: the slots of stages are written before they are read.
void DeviceBodies::make_placements(std::uint32_t slots) {
  const std::size_t slot_size = std::size_t{4} * physics::slot_vectors * vertex_count;
  const DeviceArray<std::uint32_t>& placements = arrays.make_reals("placement", slots * slot_size);
  const std::size_t slot_bytes = placements.size() * sizeof(std::uint32_t) / slots;
  arrays.carry_part("placement", physics::start_slot * slot_bytes, slot_bytes);
}

void DeviceBodies::prepare_search() {
  arrays.get<physics::BoxBits>("body_box").upload(std::vector(body_count, empty_box()));
  std::vector<physics::Status> moving_on = statuses.download();
  for (physics::Status& status : moving_on) {
    if (status.activity == physics::halted_for_now) status.activity = physics::moving;
    status.asleep = 0;
    status.folds = status.steps_to_star = 0;
  }
  statuses.upload(moving_on);
  look_at_bodies_at_rest();
}

void DeviceBodies::begin_anew() {
  for (const std::string_view boxes : {"body_box", "place_box"})
    arrays.get<physics::BoxBits>(boxes).upload(std::vector(body_count, empty_box()));
  // Marks of steps that come after the restored one would pass for those of its next steps.
  constexpr std::array<std::string_view, 1> marks{"treelet_step"};
  if (!arrays.made_buffers(marks).empty()) {
    auto& steps = arrays.get<std::uint32_t>(marks[0]);
    steps.upload(std::vector<std::uint32_t>(steps.size()));
  }
  look_at_bodies_at_rest();
}

void DeviceBodies::look_at_bodies_at_rest() {
  std::vector<physics::Status> looked_at = statuses.download();
  for (physics::Status& status : looked_at)
    if (status.calm == physics::at_rest) status.calm = physics::forgotten;
  statuses.upload(looked_at);
}

void DeviceBodies::set_time_step(double time_step) {
  physics::Control changed = control.download().front();
  changed.time_step = time_step;
  control.upload(std::span(&changed, 1));
}

void DeviceBodies::set_tableau_rows(std::span<const std::uint32_t> rows) {
  std::vector<physics::Share> changed = shares().download();
  for (physics::Share& share : changed) share.tableau_row = rows[share.body_index];
  shares().upload(changed);
  tableau_rows_.assign(rows.begin(), rows.end());
}

void DeviceBodies::cut_into_shares(const Model& model, const std::vector<bool>& are_given) {
  force_variants = choose_force_variants(abilities_of(arrays.device()), later_force_bodies_of(model, are_given));
  cut_into_shares(model, are_given, force_variants);
}

void DeviceBodies::have_all_sums_given(const Model& model) {
  const std::vector<std::size_t> given(model.bodies.size(), arrays.device().force_variants().size());
  cut_into_shares(model, std::vector<bool>(model.bodies.size(), true), given);
}

void DeviceBodies::cut_into_shares(const Model& model, const std::vector<bool>& are_given,
                                   const std::vector<std::size_t>& variants) {
  force_groups = group_shares(abilities_of(arrays.device()), later_force_bodies_of(model, are_given), variants);
  arrays.make("share", shares_of(arrays.device(), model, variants, force_groups));
  if (!tableau_rows_.empty()) set_tableau_rows(std::vector(tableau_rows_));
}

State DeviceBodies::download(std::uint32_t half) const {
  State state;
  download(half, state);
  return state;
}

void DeviceBodies::download(std::uint32_t half, State& into) const {
  arrays.device().read_ahead(std::array{poses.id(), motions.id()});
  into.poses.resize(poses.size());
  into.motion.resize(std::size_t{physics::motion_size} * vertex_count);
  poses.download(into.poses);
  motions.download(into.motion, physics::displacement_of(first_of_half(half)));
  into.path_times.clear();
  if (path_states == nullptr) return;
  for (const physics::PathState& path : path_states->download()) into.path_times.push_back(path.time);
}

}  // namespace pliant
