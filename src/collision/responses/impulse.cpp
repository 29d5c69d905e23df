#include "collision/responses/impulse.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "collision/responses/sleep_bounds.hpp"
#include "collision/responses/surroundings.hpp"
#include "core/bytes.hpp"
#include "core/error.hpp"
#include "dynamics/stability.hpp"
#include "model/mean_edge.hpp"
#include "physics/contact/impact.glsl"
#include "state/vertex_parts.hpp"

namespace pliant {
namespace {

constexpr double unbounded = 1e30;  // [s]
// Heaps of small bodies had up to 7 pairs of triangles whose cages overlap for each triangle, and 0.16 contacts. A body that may
// meet itself has more of its own, because triangles are near their neighbours.
constexpr std::uint64_t pairs_of_triangle = 16, own_pairs_of_triangle = 48, fewest_triangle_pairs = 1u << 20,
                        most_triangle_pairs = 1u << 22;
constexpr std::uint64_t fewest_contacts = 1u << 16, most_contacts = 1u << physics::kept_index_bits;
constexpr std::uint64_t features_of_pair = 15;  // of two triangles, each of which may have a contact
constexpr std::size_t contact_numbers = 4 * physics::contact_rows;

// Static bodies take part in impacts only if they have a restitution of their own.
std::optional<double> restitution_of(const ModelBody& body, const CollisionDescription& description) {
  return body.restitution || body.is_rigid() ? body.restitution : description.restitution;
}

// Contacts matter within 1.5 gaps. A pair's gap is at most the mean of what its bodies have. A static body takes the other's
// edge, so that the moving one has to count for both.
void find_nearness(std::span<physics::Surface> surfaces) {
  double largest_static_gap = 0;
  for (const physics::Surface& surface : surfaces)
    if (surface.inverse_mass == 0) largest_static_gap = std::max(largest_static_gap, surface.gap);
  for (physics::Surface& surface : surfaces)
    if (surface.inverse_mass != 0)
      surface.nearness = 1.5 * surface.edge * std::max(0.5 * surface.gap, std::sqrt(surface.gap * largest_static_gap));
}

// Returns the longest step while contacts press the body [s]. Damping takes a part of a kick within the step, which the next step
// does not foresee. In longer steps piles of damped bodies jam (docs/contact.md).
double longest_pressed(const ModelBody& body, DampingLaw law) {
  const double rate = stiffest_frequency(body) + largest_damping_rate(body, law) / 2;
  return body.is_rigid() ? unbounded : physics::longest_pressed_rate / std::max(rate, 1e-30);
}

std::vector<physics::Surface> surfaces_of(const ResponseSetting& setting) {
  std::vector<physics::Surface> surfaces;
  for (const ModelBody& body : setting.model.bodies) {
    physics::Surface& surface = surfaces.emplace_back(surface_of(setting.model, body, setting.description));
    surface.longest_pressed = longest_pressed(body, setting.steps.damping_law);
  }
  find_nearness(surfaces);
  return surfaces;
}

// Of bodies that move [m]. 0 if none does.
double smallest_gap(std::span<const physics::Surface> surfaces) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const physics::Surface& surface : surfaces)
    if (surface.inverse_mass != 0) smallest = std::min(smallest, surface.gap * surface.edge);
  return std::isinf(smallest) ? 0 : smallest;
}

// All pairs of triangles of different bodies of which one moves, and of one that meets itself, if they are not too many.
std::uint32_t room_for_triangle_pairs(const Model& model) {
  std::uint64_t triangles = 0, moving = 0, pairs = 0;
  for (const ModelBody& body : model.bodies) {
    pairs += (body.is_rigid() ? moving : triangles) * body.triangle_count;
    if (body.self_contact) pairs += std::uint64_t{body.triangle_count} * body.triangle_count / 2;
    triangles += body.triangle_count;
    if (!body.is_rigid()) moving += body.triangle_count;
  }
  const bool has_own = std::ranges::any_of(model.bodies, &ModelBody::self_contact);
  const std::uint64_t room =
      std::clamp((has_own ? own_pairs_of_triangle : pairs_of_triangle) * triangles, fewest_triangle_pairs, most_triangle_pairs);
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(pairs, 1, room));
}

// All that may be found, if they are not too many.
std::uint32_t room_for_contacts(const Model& model, std::size_t triangles) {
  const std::uint64_t all = features_of_pair * room_for_triangle_pairs(model) + model.grounds.size() * model.vertex_count();
  return static_cast<std::uint32_t>(std::min(all, std::clamp<std::uint64_t>(triangles / 4, fewest_contacts, most_contacts)));
}

class Impulse final : public Response {
 public:
  explicit Impulse(const ResponseSetting& setting)
      : bodies_(setting.bodies),
        body_pairs_(setting.body_pairs),
        trees_(setting.trees),
        scripted_bodies_(setting.bodies, setting.model),
        has_pairs_(setting.model.has_surfaces_to_touch()),
        divides_steps_(!setting.steps.vary_in_length),
        sleeps_(setting.sleeps),
        triangle_pair_capacity_(room_for_triangle_pairs(setting.model)),
        contact_capacity_(room_for_contacts(setting.model, setting.forest.triangles.size())),
        items_at_once_(setting.bodies.arrays.device().items_of_lists(setting.bodies.body_count)) {
    std::vector<physics::Surface> surfaces = surfaces_of(setting);
    for (const ModelBody& body : setting.model.bodies) largest_body_ = std::max(largest_body_, body.radius);
    if (std::ranges::any_of(setting.model.bodies, &ModelBody::self_contact))
      triangles_to_watch_ = static_cast<std::uint32_t>(setting.forest.triangles.size());
    smallest_gap_ = smallest_gap(surfaces);
    bodies_.arrays.make("triangle_around", surroundings_of(setting.model, setting.forest, surfaces));
    bodies_.arrays.make("surface", surfaces);
    bodies_.arrays.set_parameter("has_rigid_bodies", std::ranges::any_of(setting.model.bodies, &ModelBody::is_rigid) ? 1u : 0u);
    bodies_.arrays.set_parameter("gravity_size", gravity_size());
    const Foresight& foresight = setting.steps.have_forces_at_ends ? foresight_with_forces_at_ends : foresight_of_most_methods;
    bodies_.arrays.set_parameter("share_of_end", foresight.share_of_end);
    bodies_.arrays.set_parameter("share_of_lead", foresight.share_of_lead);
    keeps_leads_ = foresight.share_of_lead != 0;
    bodies_.arrays.set_parameter("watches_stars", triangles_to_watch_ > 0 ? 1u : 0u);
    bodies_.arrays.set_parameter("may_undo_steps", divides_steps_ ? 0u : 1u);
    bodies_.arrays.set_parameter("sleep_speed", sleeps_ ? sleep_speed(setting.model, gravity_size()) : 0.0);
    if (sleeps_) make_slow_places(setting.model);
    make_grounds(setting);
    make_step_parts();
    make_motions();
    make_lists();
    make_kept_impulses();
    make_debts(setting.model);
    if (std::ranges::any_of(surfaces, [](const physics::Surface& surface) { return surface.restitution >= 0; })) make_impacts();
  }

  std::vector<Pass> before_step(std::uint32_t from_half) const override {
    const Arrays& arrays = bodies_.arrays;
    std::vector<Pass> passes;
    if (restores_)
      passes.push_back(
          round_pass("restore_impacts", {{"from_half", from_half}, {"part_count", part_count_}, {"least_speed", least_speed()}}));
    passes.push_back(make_pass(arrays, "measure_motion", {{"from_half", from_half}}, bodies_.vertex_count));
    std::ranges::move(scripted_bodies_.bounding_passes(), std::back_inserter(passes));
    if (triangles_to_watch_ > 0)
      passes.push_back(make_pass(arrays, "watch_folds", {{"largest_body", largest_body_}}, triangles_to_watch_));
    std::ranges::move(body_pairs_.limiting_passes(), std::back_inserter(passes));
    if (bodies_.body_count > 1) passes.push_back(round_pass("find_flights", {}));
    std::ranges::move(scripted_bodies_.following_passes(), std::back_inserter(passes));
    passes.push_back(make_pass(arrays, "expect_motion", {}, bodies_.vertex_count));
    if (keeps_impulses()) {
      passes.push_back(make_pass(arrays, "keep_impulses",
                                 {{"kept_slot_count", kept_slot_count()}, {"contacts_at_once", items_at_once_}}, items_at_once_));
      passes.back().beside_next = has_pairs_;  // pairs of bodies know no contacts, and only count in `control`
    }
    if (has_pairs_) {
      // A GPU waits for its slowest thread. One in software gains nothing, but so tests see what others do.
      const bool is_gpu = arrays.device().info().kind == DeviceKind::gpu;
      std::ranges::move(body_pairs_.pairing_passes(), std::back_inserter(passes));
      std::ranges::move(trees_.cage_passes(triangle_pair_capacity_), std::back_inserter(passes));
      passes.push_back(make_pass(arrays, "find_contacts",
                                 {{"triangle_pair_capacity", triangle_pair_capacity_},
                                  {"contact_capacity", contact_capacity_},
                                  {"threads_at_once", items_at_once_},
                                  {"most_threads_of_a_pair", is_gpu ? 16u : 1u}},
                                 items_at_once_));
      passes.back().beside_next = ground_count_ > 0;  // both only add to the list of contacts
    }
    if (ground_count_ > 0)
      passes.push_back(make_pass(arrays, "meet_grounds", {{"contact_capacity", contact_capacity_}}, bodies_.vertex_count));
    passes.push_back(make_pass(
        arrays, "take_up_impulses",
        {{"contact_capacity", contact_capacity_}, {"kept_slot_count", kept_slot_count()}, {"contacts_at_once", items_at_once_}},
        items_at_once_));
    passes.push_back(round_pass("solve_contacts", {{"from_half", from_half},
                                                   {"contact_capacity", contact_capacity_},
                                                   {"triangle_pair_capacity", triangle_pair_capacity_},
                                                   {"least_speed", least_speed()}}));
    return passes;
  }

  ResponseReport report() const override {
    const std::vector<double> total = bodies_.arrays.get<double>("contact_total").download();
    return {.outside_impulse = {total[0], total[1], total[2]},
            .energy_given = total[physics::energy_given],
            .energy_taken = total[physics::energy_taken],
            .friction_work = total[physics::friction_work],
            .work_of_scripts = total[physics::work_of_scripts],
            .scripts = scripted_bodies_.report()};
  }
  std::vector<ContactImpulse> contact_impulses() const override {
    std::vector<ContactImpulse> contacts;
    for (const GivenImpulse& c : given_impulses()) {
      const bool has_ground = c.vertex.y == physics::no_vertex;
      contacts.push_back({.vertex = c.vertex,
                          .weight = has_ground ? glm::dvec4(1, 0, 0, 0) : c.weight,
                          .impulse = c.impulse.x * c.normal + glm::dvec3(c.impulse.y, c.impulse.z, c.impulse.w)});
    }
    return contacts;
  }

  // Contacts are sorted, because lists are in no fixed order.
  std::string save() const override {
    std::vector<GivenImpulse> contacts = given_impulses();
    const auto key = [](const GivenImpulse& c) { return std::tuple(c.vertex.x, c.vertex.y, c.vertex.z, c.vertex.w, c.weight.w); };
    std::ranges::sort(contacts, {}, key);
    ByteWriter saved;
    for (const GivenImpulse& c : contacts) saved(c.vertex, c.weight, c.impulse);
    return saved.take();
  }
  void restore(std::string_view saved) override {
    std::vector<glm::uvec4> vertices;
    std::vector<double> rows, impulses;
    for (ByteReader from(saved); !from.at_end();) {
      GivenImpulse c{};
      from(c.vertex, c.weight, c.impulse);
      vertices.push_back(c.vertex);
      rows.resize(rows.size() + contact_numbers);
      std::ranges::copy(std::span(&c.weight.x, 4), rows.end() - (contact_numbers - 4));
      impulses.insert(impulses.end(), &c.impulse.x, &c.impulse.x + 4);
    }
    if (vertices.size() > contact_capacity_)
      throw Error(ErrorKind::input, "", "its state has more contacts than there is room for", "");
    Arrays& arrays = bodies_.arrays;
    arrays.get<glm::uvec4>("contact_vertex").upload(vertices);
    upload_reals(*contacts_, rows);
    upload_reals(*impulses_, impulses);
    auto& list = arrays.get<physics::ContactList>("contact_list");
    physics::ContactList lengths = list.download().front();
    lengths.latest_count = static_cast<std::uint32_t>(vertices.size());
    list.upload(std::span(&lengths, 1));
    if (keeps_impulses()) arrays.get<std::uint32_t>("kept_slot").upload(std::vector<std::uint32_t>(kept_slot_count()));
  }
  const DeviceArray<physics::StepParts>* step_parts() const override { return parts_; }

  std::vector<Pass> before_quiet_steps(std::uint32_t from_half) const override {
    if (restores_ || !divides_steps_ || !scripted_bodies_.is_empty()) return {};
    const Arrays& arrays = bodies_.arrays;
    const std::uint32_t threads =
        std::clamp(arrays.device().parallel_items(bodies_.body_count) / bodies_.body_count, 1u, bodies_.body_count);
    return {
        make_pass(arrays, "measure_motion", {{"from_half", from_half}}, bodies_.vertex_count),
        make_pass(arrays, "limit_quiet_steps", {{"threads_of_a_body", threads}}, threads * bodies_.body_count),
        make_pass(arrays, "bound_quiet_steps", {{"from_half", from_half}, {"largest_body", largest_body_}}, bodies_.body_count)};
  }
  std::vector<Pass> after_quiet_steps() const override {
    return {make_pass(bodies_.arrays, "end_quiet_parts", {}, bodies_.body_count)};
  }

  std::vector<Pass> after_step(std::uint32_t from_half) const override {
    const Arrays& arrays = bodies_.arrays;
    std::vector<Pass> passes = scripted_bodies_.moving_passes(from_half);
    passes.push_back(make_pass(arrays, "expect_cuts",
                               {{"from_half", from_half}, {"least_speed", least_speed()}, {"largest_body", largest_body_}},
                               bodies_.vertex_count));
    if (restores_)
      passes.push_back(make_pass(arrays, "sum_impacts",
                                 {{"contact_capacity", contact_capacity_},
                                  {"triangle_pair_capacity", triangle_pair_capacity_},
                                  {"contacts_at_once", items_at_once_},
                                  {"least_speed", least_speed()}},
                                 items_at_once_));
    if (has_pairs_) passes.push_back(certifying_pass());
    passes.push_back(make_pass(
        arrays, "settle",
        {{"from_half", from_half}, {"triangle_pair_capacity", triangle_pair_capacity_}, {"contact_capacity", contact_capacity_}},
        bodies_.vertex_count));
    std::ranges::move(scripted_bodies_.ending_passes(
                          {{"triangle_pair_capacity", triangle_pair_capacity_}, {"contact_capacity", contact_capacity_}}),
                      std::back_inserter(passes));
    passes.push_back(round_pass("pay_dues", {{"from_half", from_half},
                                             {"part_count", part_count_},
                                             {"triangle_pair_capacity", triangle_pair_capacity_},
                                             {"contact_capacity", contact_capacity_}}));
    if (sleeps_) passes.push_back(round_pass("find_sleepers", {{"from_half", from_half}}));
    return passes;
  }

 private:
  void make_grounds(const ResponseSetting& setting) {
    std::vector<physics::Ground> grounds;
    for (const Ground& ground : setting.model.grounds) grounds.push_back(ground_of(ground, setting.description));
    ground_count_ = static_cast<std::uint32_t>(grounds.size());
    bodies_.arrays.set_parameter("ground_count", ground_count_);
    if (grounds.empty()) grounds.push_back({});
    bodies_.arrays.make("ground", grounds);
  }

  void make_slow_places(const Model& model) {
    bodies_.arrays.set_parameter("sleep_way", sleep_way(model, gravity_size()));
    bodies_.arrays.make<glm::vec4>("slow_place", std::size_t{physics::sample_count} * bodies_.body_count);
  }

  void make_step_parts() {
    time_step_ = bodies_.control.download().front().time_step;
    parts_ = &bodies_.arrays.make("step_parts", std::vector{physics::before_first_part(time_step_, divides_steps_)});
    if (divides_steps_) bodies_.arrays.set_parameter("parts_of", time_step_);
  }

  // What each body and vertex does and is expected to do in a step.
  void make_motions() {
    Arrays& arrays = bodies_.arrays;
    const std::size_t vertices = bodies_.vertex_count;
    arrays.make("body_motion", std::vector(bodies_.body_count, physics::BoxBits{.lower = {~0u, ~0u, ~0u}, .upper = {}}));
    const std::uint32_t none = physics::ordered_bits(0.0f);
    arrays.make("room", std::vector(bodies_.body_count, physics::Room{.to_others = physics::no_bound,
                                                                      .least_push = {none, none, none},
                                                                      .most_push = {none, none, none}}));
    arrays.make<std::uint32_t>("pressed", bodies_.body_count);
    arrays.make<double>("start", 6 * vertices);
    arrays.make<double>("unkicked_velocity", divides_steps_ ? 1 : 3 * vertices);
    arrays.make<double>("expected", 3 * vertices);
    arrays.make_reals("surplus", (keeps_leads_ ? 9 : 6) * vertices);
    arrays.make<glm::vec2>("cage", 6 * vertices);
    arrays.make<double>("way", 3 * vertices);
    arrays.make<std::uint32_t>("cut", physics::flight_stop_of(bodies_.vertex_count, 2 * bodies_.body_count));
    arrays.make<std::uint32_t>("last_cut", vertices);
  }

  // Pairs of triangles, contacts, and sums of what they give.
  void make_lists() {
    Arrays& arrays = bodies_.arrays;
    arrays.make<physics::ContactList>("contact_list", 1);
    arrays.make<glm::uvec2>("triangle_pair", triangle_pair_capacity_);
    arrays.make<glm::uvec4>("contact_vertex", contact_capacity_);
    contacts_ = &arrays.make_reals("contact", contact_numbers * contact_capacity_);
    impulses_ = &arrays.make_reals("contact_impulse", std::size_t{4} * contact_capacity_);
    arrays.make<std::uint32_t>("contact_weight", bodies_.vertex_count);
    arrays.make<glm::uvec2>("impulse_sum", physics::sum_buffers * std::size_t{3} * bodies_.vertex_count);
    arrays.make<glm::uvec2>("contact_sum", physics::contact_sum_count(bodies_.body_count));
    arrays.make<double>("contact_total", physics::contact_sum_count(bodies_.body_count));
  }

  void make_kept_impulses() {
    Arrays& arrays = bodies_.arrays;
    arrays.set_parameter("keeps_impulses", keeps_impulses() ? 1u : 0u);
    const std::size_t contacts = keeps_impulses() ? contact_capacity_ : 0;
    arrays.make<std::uint32_t>("kept_slot", kept_slot_count());
    arrays.make<glm::uvec4>("kept_key", contacts);
    arrays.make_reals("kept_impulse", 4 * contacts);
  }

  void make_debts(const Model& model) {
    Arrays& arrays = bodies_.arrays;
    const VertexParts all = vertex_parts(
        model, [](const ModelBody& body) { return !body.is_rigid(); }, cube_root_part);
    part_count_ = all.count();
    arrays.make("vertex_part", all.parts);
    arrays.make("vertex_part_range", all.ranges);
    arrays.make<physics::PartSums>("part_sum", part_count_);
    arrays.make<physics::Cluster>("cluster", bodies_.body_count + 1);
    arrays.make<std::uint32_t>("island_scale", 2 * bodies_.body_count);
    arrays.make<glm::uvec2>("island_sum", 4 * bodies_.body_count);
    arrays.make<physics::Debt>("debt", bodies_.body_count + 1);
  }

  void make_impacts() {
    Arrays& arrays = bodies_.arrays;
    const std::size_t impacts = physics::impact_count(bodies_.body_count);
    arrays.make<std::uint32_t>("impact_partner", impacts);
    arrays.make<glm::uvec2>("impact_sum", 3 * impacts);
    arrays.make<double>("impact_approach", impacts);
    arrays.make<std::uint32_t>("impact_part", physics::latest_of_all(bodies_.body_count) + 1);
    restores_ = true;
  }

  // A contact that gave an impulse in the latest step, as physics/contact/contact.glsl says.
  struct GivenImpulse {
    glm::uvec4 vertex{0};
    glm::dvec3 normal{0.0};
    glm::dvec4 weight{0.0}, impulse{0.0};
  };
  std::vector<GivenImpulse> given_impulses() const {
    const std::size_t count = bodies_.arrays.get<physics::ContactList>("contact_list").download().front().latest_count;
    if (count == 0) return {};
    const std::vector<glm::uvec4> vertices = bodies_.arrays.get<glm::uvec4>("contact_vertex").download(0, count);
    const std::vector<double> rows = download_reals(*contacts_, contact_numbers * count),
                              impulses = download_reals(*impulses_, 4 * count);
    std::vector<GivenImpulse> contacts;
    for (std::size_t c = 0; c < count; ++c) {
      const double *const row = &rows[contact_numbers * c], *const impulse = &impulses[4 * c];
      if (impulse[0] > 0)
        contacts.push_back({.vertex = vertices[c],
                            .normal = {row[0], row[1], row[2]},
                            .weight = {row[4], row[5], row[6], row[7]},
                            .impulse = {impulse[0], impulse[1], impulse[2], impulse[3]}});
    }
    return contacts;
  }

  // A vertex that only one ground touches gets its impulse in a round.
  bool keeps_impulses() const { return has_pairs_ || ground_count_ > 1; }

  // A power of two. Entries of a step that had the same number may still stand beside those of this one.
  std::uint32_t kept_slot_count() const { return keeps_impulses() ? std::bit_ceil(2 * contact_capacity_) : 1; }

  Pass round_pass(std::string_view name, const Parameters& parameters) const {
    return make_round_pass(bodies_.arrays, name, parameters);
  }

  // Proves that triangles stay apart, or cuts motions short.
  Pass certifying_pass() const {
    Parameters parameters = {{"triangle_pair_capacity", triangle_pair_capacity_}, {"largest_body", largest_body_}};
    if (triangles_to_watch_ == 0) return round_pass("certify", parameters);
    parameters.emplace_back("triangle_count", triangles_to_watch_);
    return round_pass("certify_self_contact", parameters);
  }

  // The first `count` numbers of the device's precision.
  std::vector<double> download_reals(const DeviceArray<std::uint32_t>& array, std::size_t count) const {
    const bool is_double = bodies_.arrays.device().precision() == 64;
    const std::vector<std::uint32_t> words = array.download(0, is_double ? 2 * count : count);
    std::vector<double> numbers(count);
    for (std::size_t i = 0; i < count; ++i)
      numbers[i] = is_double ? std::bit_cast<double>(std::uint64_t{words[2 * i + 1]} << 32 | words[2 * i])
                             : static_cast<double>(std::bit_cast<float>(words[i]));
    return numbers;
  }

  void upload_reals(DeviceArray<std::uint32_t>& array, std::span<const double> numbers) const {
    std::vector<std::uint32_t> words;
    for (const double number : numbers) {
      const auto bits = std::bit_cast<std::uint64_t>(number);
      if (bodies_.arrays.device().precision() == 32)
        words.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(number)));
      else
        words.insert(words.end(), {static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32)});
    }
    array.upload(words);
  }

  // Frames turn the scene's gravity, and leave its size [m/s^2].
  double gravity_size() const {
    const physics::Pose pose = bodies_.poses.download(0, 1).front();
    return std::hypot(pose.gravity[0], pose.gravity[1], pose.gravity[2]);
  }

  // Impulses are counted in quanta of what a vertex has at this speed, at least [m/s].
  double least_speed() const { return smallest_gap_ / time_step_; }

  DeviceBodies& bodies_;
  const BodyPairs& body_pairs_;
  const TreeSearch& trees_;
  ScriptedBodies scripted_bodies_;
  bool has_pairs_, divides_steps_, sleeps_, restores_ = false, keeps_leads_ = false;
  std::uint32_t triangle_pair_capacity_, contact_capacity_, items_at_once_, ground_count_ = 0, part_count_ = 0,
                                                                            triangles_to_watch_ = 0;
  double smallest_gap_ = 0, time_step_ = 0, largest_body_ = 0;
  const DeviceArray<physics::StepParts>* parts_ = nullptr;
  DeviceArray<std::uint32_t>*contacts_ = nullptr, *impulses_ = nullptr;  // numbers of the device's precision
};

std::unique_ptr<Response> make_impulse(const ResponseSetting& setting) { return std::make_unique<Impulse>(setting); }

}  // namespace

physics::Surface surface_of(const Model& model, const ModelBody& body, const CollisionDescription& description) {
  return {.edge = body.triangle_count > 0 ? mean_edge(model, body) : body.radius,
          .inverse_mass = body.is_rigid() ? 0 : 1 / body.vertex_mass,
          .elasticity = body.surface.elasticity.value_or(elasticity_of(description)),
          .friction = body.surface.friction.value_or(description.friction),
          .gap = body.surface.gap.value_or(description.gap),
          .restitution = restitution_of(body, description).value_or(-1),
          .longest_pressed = unbounded,
          .frequency = body.is_rigid() ? 0 : stiffest_frequency(body),
          .diameter = 2 * body.radius,
          .nearness = 0,
          .first_vertex = body.first_vertex,
          .to_mesh = 0,
          .meets_itself = body.self_contact ? 1u : 0u,
          .padding = 0,
          .winding = double(body.winding)};
}

physics::Ground ground_of(const Ground& ground, const CollisionDescription& description) {
  return {.normal = {ground.normal.x, ground.normal.y, ground.normal.z},
          .offset = ground.offset,
          .elasticity = ground.surface.elasticity.value_or(elasticity_of(description)),
          .friction = ground.surface.friction.value_or(description.friction),
          .gap = ground.surface.gap.value_or(description.gap)};
}

ResponseRow impulse_row() {
  return {.name = "impulse",
          .make = make_impulse,
          .elasticity = 0.5,
          .law_with_gravity = DampingLaw::internal,  // it does not slow a fall
          .allows_immovable = true,
          .allows_brute_force = false,
          .divides_steps = true,
          .keeps_apart = true,
          .gives_impulses = true,
          .reads_surfaces = true,
          .answers_touching = false};
}

}  // namespace pliant
