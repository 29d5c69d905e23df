#include "bench/drops/drops.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <utility>

#include "bench/drops/soft_peer.hpp"
#include "core/larger.hpp"
#include "core/stopwatch.hpp"
#include "dynamics/integrator.hpp"
#include "dynamics/stability.hpp"
#include "mesh/generators.hpp"
#include "mesh/obj.hpp"
#include "model/inflation.hpp"
#include "simulation/overlap.hpp"
#include "simulation/simulation.hpp"

namespace pliant::bench {
namespace {

constexpr double gravity = 9.81, looks_a_second = 60;
constexpr double stiffness = 5e4, stiffness_in_stack = 4e5;          // of a body of 1 kg: N k [N/m]
constexpr double damping_rate = 5;                                   // c / m [1/s]
constexpr std::array peer_steps = {1.0 / 60, 1.0 / 240, 1.0 / 960};  // [s]
constexpr double omega_step = 0.5;                                   // of pliant's steps

struct Drop {
  std::string name;
  ModelAndState start;
  double fall = 0;      // of the lowest body to the floor [m]
  double duration = 0;  // [s]
};

// A body of this radius whose lowest vertex begins at this height [m].
BodySetup body_of(TriangleMesh mesh, const std::string& name, double radius, double lowest) {
  glm::dvec3 middle(0.0);
  for (const glm::dvec3& p : mesh.positions) middle += p / static_cast<double>(mesh.positions.size());
  double farthest = 0;
  for (glm::dvec3& p : mesh.positions) farthest = std::max(farthest, glm::length(p -= middle));
  double least = 0;
  for (glm::dvec3& p : mesh.positions) least = std::min(least, (p *= radius / farthest).y);
  BodySetup setup{.mesh = std::move(mesh), .description = {}};
  setup.description.name = name;
  setup.description.position = {0, lowest - least, 0};
  setup.description.total_mass = 1;
  setup.description.total_stiffness = stiffness;
  setup.description.damping = damping_rate / static_cast<double>(setup.mesh.positions.size());
  return setup;
}

Drop drop_of(std::string name, const std::vector<BodySetup>& setups, double fall, double duration) {
  return {std::move(name), build_model(setups, {0, -gravity, 0}, std::array{GroundDescription()}), fall, duration};
}

std::vector<Drop> drops_of(const DropsOptions& options) {
  const double duration = options.quick ? 0.3 : 3;
  std::vector<Drop> drops;
  const int level = options.quick ? 1 : 3;
  drops.push_back(drop_of("sphere", {body_of(generate_mesh(fmt::format("icosphere:{}", level)), "sphere", 0.5, 1)}, 1, duration));
  if (!options.quick) {
    TriangleMesh bunny = load_obj(options.scenes.parent_path() / "meshes" / "bunny.obj").mesh;
    drops.push_back(drop_of("bunny", {body_of(std::move(bunny), "bunny", 0.5, 1)}, 1, duration));
  }
  std::vector<BodySetup> stack;
  constexpr double side = 0.3, apart = 0.03, diagonal = 1.7320508;  // [m], [m], of a cube over its side
  for (int k = 0; k < 10; ++k) {
    stack.push_back(
        body_of(generate_mesh("cube:3"), fmt::format("cube {}", k), 0.5 * diagonal * side, apart + (side + apart) * k));
    stack.back().description.total_stiffness = stiffness_in_stack;
  }
  drops.push_back(drop_of("stack of ten", stack, apart, duration));
  return drops;
}

// What a drop has been like at each look.
class Witness {
 public:
  explicit Witness(const Drop& drop) : drop_(drop), model_(drop.start.model), rest_(drop.start.state.world_positions(model_)) {
    first_energy_ = energy(rest_, drop.start.state.world_velocities(model_));
    first_height_ = highest(rest_);
  }

  void look(std::span<const glm::dvec3> positions, std::span<const glm::dvec3> velocities, DropRow& row) const {
    glm::dvec3 momentum(0.0);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      row.depth = larger(row.depth, -positions[i].y);
      momentum += model_.body_of(i).vertex_mass * velocities[i];
    }
    for (const ModelBody& body : model_.bodies) {
      const auto volume_at = [&](std::span<const glm::dvec3> all) {
        return volume_of(model_, body, all.subspan(body.first_vertex, body.vertex_count));
      };
      row.least_volume = std::min(row.least_volume, volume_at(positions) / volume_at(rest_));
    }
    const double given = gravity * drop_.fall * static_cast<double>(model_.bodies.size());  // [J] of 1 kg each
    row.most_energy = larger(row.most_energy, (energy(positions, velocities) - first_energy_) / given);
    row.sideways = larger(row.sideways, std::hypot(momentum.x, momentum.z) / std::sqrt(2 * gravity * drop_.fall));
    row.intersections += count_touching_pairs(model_, positions);
    row.last_height = highest(positions) / first_height_;
  }

 private:
  [[nodiscard]] double energy(std::span<const glm::dvec3> positions, std::span<const glm::dvec3> velocities) const {
    double sum = 0;
    for (std::size_t i = 0; i < positions.size(); ++i)
      sum += model_.body_of(i).vertex_mass * (glm::dot(velocities[i], velocities[i]) / 2 + gravity * positions[i].y);
    return sum;
  }
  // Of the highest body's mean.
  [[nodiscard]] double highest(std::span<const glm::dvec3> positions) const {
    double most = 0;
    for (const ModelBody& body : model_.bodies) {
      double sum = 0;
      for (std::uint32_t i = 0; i < body.vertex_count; ++i) sum += positions[body.first_vertex + i].y;
      most = std::max(most, sum / body.vertex_count);
    }
    return most;
  }

  const Drop& drop_;
  const Model& model_;
  std::vector<glm::dvec3> rest_;
  double first_energy_ = 0, first_height_ = 1;
};

// Calls advance(look) and look(row) in turns. Only advancing is timed.
DropRow watch(const Drop& drop, DropRow row, const std::function<void()>& advance,
              const std::function<void(const Witness&, DropRow&)>& look) {
  const Witness witness(drop);
  const auto looks = static_cast<int>(std::lround(drop.duration * looks_a_second));
  Stopwatch stopwatch;
  for (int k = 0; k < looks; ++k) {
    stopwatch.time(advance);
    look(witness, row);
  }
  row.drop = drop.name;
  row.vertices = drop.start.model.vertex_count();
  row.seconds_per_second = stopwatch.seconds() / drop.duration;
  return row;
}

DropRow measure_pliant(const Drop& drop, const Place& place, const char* integrator) {
  const std::unique_ptr<Device> device = open(place);
  const Model& model = drop.start.model;
  double fastest = 0;
  for (const ModelBody& body : model.bodies) fastest = std::max(fastest, stiffest_frequency(body));
  // so many steps between two looks
  const auto steps = static_cast<std::uint64_t>(std::ceil(fastest / (omega_step * looks_a_second)));
  const double time_step = 1 / (looks_a_second * static_cast<double>(steps));
  Simulation simulation(*device, model, drop.start.state,
                        {.integrator = &find_integrator(integrator), .time_step = time_step, .damping_law = DampingLaw::internal},
                        {.response = {"impulse"}});
  DropRow row;
  row.engine = fmt::format("pliant, {}", integrator);
  row.device = place.device;
  row.threads = place.threads;
  row.time_step = time_step;
  return watch(
      drop, row,
      [&] {
        simulation.advance(steps);
        device->finish();
      },
      [&](const Witness& witness, DropRow& into) {
        const State state = simulation.state();
        witness.look(state.world_positions(model), state.world_velocities(model), into);
      });
}

DropRow measure_peer(const Drop& drop, const SoftLibrary& library, double time_step) {
  const Model& model = drop.start.model;
  const std::unique_ptr<SoftPeer> peer = library.build(model, drop.start.state, gravity);
  std::vector<glm::dvec3> positions(model.vertex_count()), velocities(model.vertex_count());
  const auto steps = static_cast<int>(std::lround(1 / (looks_a_second * time_step)));
  DropRow row;
  row.engine = library.name;
  row.time_step = time_step;
  return watch(
      drop, row,
      [&] {
        for (int k = 0; k < steps; ++k) peer->step(time_step);
      },
      [&](const Witness& witness, DropRow& into) {
        peer->read(positions, velocities);
        witness.look(positions, velocities, into);
      });
}

}  // namespace

DropsResult bench_drops(const DropsOptions& options, const Progress& progress) {
  DropsResult result;
  const std::vector<Drop> drops = drops_of(options);
  const std::vector<SoftLibrary> libraries = bullet_bodies();
  if (libraries.empty()) result.notes.emplace_back("Bullet's soft bodies were not found when this program was built");
  std::vector<std::pair<std::string, std::function<DropRow()>>> tasks;
  for (const Drop& drop : drops) {
    for (const Place& place : places_of(options.devices, std::array{32}))
      for (const char* integrator : {"verlet", "cv8"})
        tasks.emplace_back(drop.name, [&drop, place, integrator] { return measure_pliant(drop, place, integrator); });
    for (const SoftLibrary& library : libraries)
      for (const double step : peer_steps)
        tasks.emplace_back(drop.name, [&drop, &library, step] { return measure_peer(drop, library, step); });
  }
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    result.interrupted = !progress(static_cast<double>(k) / static_cast<double>(tasks.size()), tasks[k].first);
    if (result.interrupted) return result;
    result.rows.push_back(tasks[k].second());
  }
  progress(1, "");
  return result;
}

}  // namespace pliant::bench
