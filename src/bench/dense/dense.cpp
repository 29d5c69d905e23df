#include "bench/dense/dense.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "bench/common/shapes.hpp"
#include "bench/common/timing.hpp"
#include "bench/dense/deformations.hpp"
#include "bench/dense/exact_forces.hpp"
#include "core/stopwatch.hpp"
#include "dynamics/clusters/cluster_forces.hpp"
#include "dynamics/clusters/cluster_springs.hpp"
#include "dynamics/stability.hpp"
#include "dynamics/stepper.hpp"
#include "mesh/generators.hpp"
#include "mesh/obj.hpp"
#include "mesh/subdivide.hpp"
#include "simulation/simulation.hpp"

namespace pliant::bench {
namespace {

constexpr double longest_timed = 2, longest_contact_step = 0.1;  // [s]
constexpr std::uint64_t most_steps_away = 100;                   // 30 radians of its fastest vibration
constexpr std::uint64_t steps_until_contact = 40;                // it falls for 12 of them
constexpr std::uint32_t sample_count = 300;

struct Shape {
  std::string name;
  TriangleMesh mesh;
};

Shape generated(const std::string& name) { return {name, generate_mesh(name)}; }

Shape large_cube() { return {"cube:51 split three times", subdivide(generate_mesh("cube:51"), 3)}; }

Shape bunny_split_twice(const std::filesystem::path& scenes) {
  return {"bunny split twice", subdivide(load_obj(scenes.parent_path() / "meshes" / "bunny.obj").mesh, 2)};
}

// Measures errors of one mesh.
class ErrorsOf {
 public:
  explicit ErrorsOf(const Shape& shape)
      : mesh_(shape.name), rest_(scaled_to_radius_1(shape.mesh.positions)), deformations_(deformations_of(rest_)) {
    for (const Deformation& deformation : deformations_)
      exact_.emplace_back(pool_, rest_, deformation.displacements, sample_count);
  }

  void measure(double accuracy, std::vector<DenseErrorRow>& rows) {
    const ClusterSprings springs(rest_, accuracy);
    for (std::size_t d = 0; d < deformations_.size(); ++d) {
      const std::vector<glm::dvec3> forces = springs.forces(pool_, deformations_[d].displacements);
      rows.push_back({.mesh = mesh_,
                      .vertices = static_cast<std::uint32_t>(rest_.size()),
                      .accuracy = accuracy,
                      .springs_per_vertex = static_cast<double>(springs.counts().all()) / static_cast<double>(rest_.size()),
                      .deformation = deformations_[d].name,
                      .error = exact_[d].error_of([&](std::size_t i) { return forces[i]; })});
    }
  }

 private:
  std::string mesh_;
  std::vector<glm::dvec3> rest_;
  std::vector<Deformation> deformations_;
  ThreadPool pool_{0};
  std::vector<ExactForces> exact_;  // of each deformation
};

void displace_smoothly(ModelAndState& moved) {
  const ModelBody& body = moved.model.bodies.front();
  const std::vector<glm::dvec3> rest = scaled_to_radius_1(moved.model.rest_positions_of(body));
  const std::vector<glm::dvec3> smooth = smooth_displacements_of(rest, 0.01);
  for (std::uint32_t i = 0; i < smooth.size(); ++i)
    for (int k = 0; k < 3; ++k)
      moved.state.motion[physics::displacement_of(i) + static_cast<std::size_t>(k)] = body.radius * smooth[i][k];
}

// Returns a body that falls on a ground a hundredth of its radius below. It is about as heavy as the bunny in scenes/dense: held
// by nothing but its stiffest vibration it would sink by 1.5e-3 of its radius.
ModelAndState body_above_ground(const TriangleMesh& mesh) {
  BodySetup setup{.mesh = mesh, .description = {}};
  setup.description.name = "body";
  const ModelAndState weightless = build_model({&setup, 1}, glm::dvec3(0.0));
  const ModelBody& body = weightless.model.bodies.front();
  double lowest = std::numeric_limits<double>::infinity();
  for (const glm::dvec3& p : mesh.positions) lowest = std::min(lowest, p.y);
  setup.description.position.y = 0.01 * body.radius - lowest;
  const GroundDescription ground;
  return build_model({&setup, 1}, {0, -1.5e-3 * body.radius * stiffest_frequency_squared(body), 0}, {&ground, 1});
}

// Moves one body by cv8. A step is a tenth of its bound.
class StepsOf {
 public:
  StepsOf(Device& device, ModelAndState body, std::optional<double> tolerance, const CollisionDescription& collision)
      : device_(device),
        body_(with_sums(std::move(body), tolerance)),
        simulation_(device, body_.model, body_.state,
                    {.integrator = &cv8_, .time_step = 0.1 * step_bound(cv8_, body_.model.bodies.front(), DampingLaw::none)},
                    collision) {}

  struct Timed {
    double seconds = 0;        // of a step; 0 if clusters can't meet the tolerance, or the body breaks down
    double contact_share = 0;  // of the steps, or of parts if they fall into such
  };

  // Times steps after so many others. Without damping neighbours drift apart, and lists of clusters get longer. So the body goes
  // back to the start after most_steps_away. It does not go back for every batch, because a GPU lowers its clock while it waits
  // for a large body.
  Timed time_after(std::uint64_t steps_before, const Effort& effort) {
    simulation_.advance(steps_before);
    const std::string start = simulation_.save();
    std::uint64_t steps_away = 0, parts = 0, in_contact = 0;
    bool met_tolerance = true;
    const BatchTimer timer = [&](std::uint64_t steps) {
      if (steps_away + steps > most_steps_away) {
        simulation_.restore(start);
        steps_away = 0;
      }
      steps_away += steps;
      const StepReport before = simulation_.report();
      device_.mark_time();
      simulation_.advance(steps);
      device_.mark_time();
      const std::vector<double> times = device_.take_times();
      const StepReport after = simulation_.report();
      parts += after.steps + after.substeps - before.steps - before.substeps;
      in_contact += after.contact_steps - before.contact_steps;
      met_tolerance = met_tolerance && !after.breakdown && (!after.clusters || after.clusters->direct.empty());
      return times[1] - times[0];
    };
    const double seconds = seconds_each(effort, timer, load_seconds(device_, effort)).median;
    if (!met_tolerance) return {};
    return {seconds, static_cast<double>(in_contact) / static_cast<double>(parts)};
  }

 private:
  static ModelAndState with_sums(ModelAndState body, std::optional<double> tolerance) {
    ModelBody& only = body.model.bodies.front();
    only.force_tolerance = tolerance;
    only.is_clustered = tolerance.has_value();
    return body;
  }

  Device& device_;
  const Integrator& cv8_ = find_integrator("cv8");
  ModelAndState body_;
  Simulation simulation_;
};

// Measures sums of one body's forces at one place, first of all springs.
class SumsOf {
 public:
  SumsOf(Device& device, const Place& place, const Effort& effort, const ModelAndState& body, std::string mesh)
      : mesh_(std::move(mesh)),
        device_(device),
        place_(place),
        effort_(effort),
        model_(body.model),
        rest_(model_.rest_positions_of(model_.bodies.front())),
        exact_(pool_, rest_, body.state.displacements_of(model_.bodies.front()), sample_count),
        bodies_(device, model_, body.state),
        stepper_(bodies_, model_, find_integrator("verlet"), DampingLaw::none, 1e-3) {
    device.run(stepper_.first_passes());
    bytes_without_clusters_ = device.allocated_bytes();
  }

  // Returns the time of a sum of all springs [s].
  double measure_direct() {
    const std::vector<Pass> passes = stepper_.refresh_passes();  // kept forces stay marked as stale, so they sum them every time
    direct_seconds_ = seconds_each(device_, effort_, [&] { device_.run(passes); }).median;
    bytes_without_clusters_ = device_.allocated_bytes();  // a processor has taken scratch memory
    return direct_seconds_;
  }

  DenseForceRow measure(double tolerance) {
    const double accuracy = accuracy_of(tolerance);
    DenseForceRow row{.device = place_.device,
                      .precision = place_.precision,
                      .threads = place_.threads,
                      .mesh = mesh_,
                      .vertices = model_.vertex_count(),
                      .tolerance = tolerance,
                      .direct_seconds_per_sum = direct_seconds_};
    ThreadPool one(1);
    Stopwatch listing;
    listing.time([&] { return pair_clusters(one, make_cluster_tree(rest_), accuracy).far.size(); });
    row.list_seconds = listing.seconds();
    ClusterTrees trees(1);
    const ClusterForces forces(bodies_, model_, std::vector{std::optional(ListBasis{accuracy})}, trees);
    row.bytes_per_vertex = static_cast<double>(device_.allocated_bytes() - bytes_without_clusters_) / row.vertices;
    const std::vector<Pass> passes = forces.passes(physics::start_slot, false);
    row.seconds_per_sum = seconds_each(device_, effort_, [&] { device_.run(passes); }).median;
    for (const Pass& pass : passes)  // each finds what those before it have left
      row.pass_seconds.emplace_back(pass.name, seconds_each(device_, effort_, [&] { device_.run({&pass, 1}); }).median);
    const std::vector<double> sums = bodies_.arrays.get<double>("spring_sum").download();
    row.error = exact_.error_of([&](std::size_t i) {
      return -model_.bodies.front().unit_of_length() * glm::dvec3(sums[3 * i], sums[3 * i + 1], sums[3 * i + 2]);
    });
    return row;
  }

 private:
  std::string mesh_;
  Device& device_;
  const Place& place_;
  const Effort& effort_;
  const Model& model_;
  std::vector<glm::dvec3> rest_;
  ThreadPool pool_{0};
  ExactForces exact_;
  DeviceBodies bodies_;
  Stepper stepper_;
  std::size_t bytes_without_clusters_ = 0;
  double direct_seconds_ = 0;  // 0: not measured
};

class Suite {
 public:
  Suite(const DenseOptions& options, const Progress& progress)
      : quick_(options.quick), progress_(progress), places_(places_of(options.devices, std::array{32, 64})) {
    for (const int level : quick_ ? std::vector{3, 4} : std::vector{4, 5, 6, 7, 8})
      shapes_.push_back(generated(fmt::format("icosphere:{}", level)));
    if (!quick_) {
      shapes_.push_back(generated("cube:78"));  // 36,506 vertices: about as many as the Stanford bunny
      shapes_.push_back(bunny_split_twice(options.scenes));
      shapes_.push_back(large_cube());
    }
    std::ranges::stable_sort(shapes_, {}, [](const Shape& shape) { return shape.mesh.positions.size(); });
    steps_ = shapes_.size() * (1 + places_.size());
  }

  DenseResult run() {
    measure_errors();
    for (const Place& place : places_) measure_sums(place);
    if (!result_.interrupted) progress_(1, "");
    return std::move(result_);
  }

 private:
  bool goes_on(const std::string& next) {
    if (!result_.interrupted) result_.interrupted = !progress_(static_cast<double>(done_++) / static_cast<double>(steps_), next);
    return !result_.interrupted;
  }

  // Exact forces on a larger body would take minutes.
  static std::vector<double> accuracies_for(const Shape& shape) {
    const std::size_t vertices = shape.mesh.positions.size();
    if (vertices > 200'000) return {};
    return vertices > 20'000 && vertices < 100'000 ? std::vector{1e-6, 1e-7, 1e-8, 1e-9} : std::vector{1e-7};
  }

  void measure_errors() {
    for (const Shape& shape : shapes_) {
      if (!goes_on("errors of " + shape.name)) return;
      const std::vector<double> accuracies = accuracies_for(shape);
      if (accuracies.empty()) continue;
      ErrorsOf errors(shape);
      for (const double accuracy : accuracies) errors.measure(accuracy, result_.rows);
    }
  }

  void measure_sums(const Place& place) {
    if (result_.interrupted) return;
    const std::unique_ptr<Device> device = open(place);
    const Effort effort = quick_ ? quick_effort : Effort{};
    double seconds_per_pair = 0;  // of a sum of all springs, by the largest body so far
    for (const Shape& shape : shapes_) {
      const std::string what = fmt::format("{}, {}", name_of(place), shape.name);
      if (!goes_on(what)) return;
      const ModelAndState body = deformed_body(shape.mesh);
      const double pairs = std::pow(body.model.vertex_count(), 2), expected = seconds_per_pair * pairs;
      SumsOf sums(*device, place, effort, body, shape.name);
      if (expected > longest_timed)
        result_.notes.push_back(fmt::format("{}: all springs left out, as a sum would take about {:.2g} s", what, expected));
      else
        seconds_per_pair = sums.measure_direct() / pairs;
      const double direct_step = measured_step(*device, effort, body, {}, 11 * expected);
      for (const double tolerance : quick_ ? std::vector{1e-3} : std::vector{1e-3, 1e-4}) {
        DenseForceRow& row = result_.forces.emplace_back(sums.measure(tolerance));
        row.direct_seconds_per_step = direct_step;
        row.seconds_per_step = measured_step(*device, effort, body, tolerance, 11 * row.seconds_per_sum);
        measure_contact_steps(*device, effort, shape.mesh, row);
      }
    }
  }

  // Returns the time of a step of a smoothly deformed body. It is 0 if one would take long, or if clusters can't meet the
  // tolerance.
  static double measured_step(Device& device, const Effort& effort, ModelAndState body, std::optional<double> tolerance,
                              double expected) {
    if (expected > longest_timed) return 0;
    displace_smoothly(body);
    return StepsOf(device, std::move(body), tolerance, {.response = {"none"}}).time_after(1, effort).seconds;
  }

  // Times those of a body that has fallen on a ground, if they do not take long.
  static void measure_contact_steps(Device& device, const Effort& effort, const TriangleMesh& mesh, DenseForceRow& row) {
    if (11 * row.seconds_per_sum > longest_contact_step) return;
    const auto timed = StepsOf(device, body_above_ground(mesh), row.tolerance, {}).time_after(steps_until_contact, effort);
    row.seconds_per_contact_step = timed.seconds;
    if (timed.seconds > 0) row.contact_share = timed.contact_share;
  }

  bool quick_;
  const Progress& progress_;
  std::vector<Shape> shapes_;
  std::vector<Place> places_;
  std::size_t steps_ = 0, done_ = 0;
  DenseResult result_;
};

}  // namespace

DenseResult bench_dense(const DenseOptions& options, const Progress& progress) { return Suite(options, progress).run(); }

}  // namespace pliant::bench
