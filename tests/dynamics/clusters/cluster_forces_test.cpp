// Springs of clustered bodies on devices, beside the same sums in fp64 on the host.
#include "dynamics/clusters/cluster_forces.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "bench/dense/deformations.hpp"
#include "bench/dense/exact_forces.hpp"
#include "device/gpu/gpu_device.hpp"
#include "dynamics/clusters/cluster_springs.hpp"
#include "dynamics/stepper.hpp"
#include "support/evolve.hpp"
#include "support/has.hpp"

namespace pliant {
namespace {

constexpr double tested_accuracy = 1e-7;

// A slightly bent sheet.
TriangleMesh sheet() {
  TriangleMesh mesh;
  for (int i = 0; i < 20; ++i)
    for (int k = 0; k < 20; ++k) mesh.positions.emplace_back(0.1 * i, 0.0001 * i * i, 0.1 * k);
  return mesh;
}

TriangleMesh few_points() { return {{{0, 0, 0}, {1, 0.1, 0}, {0, 1, 0.2}, {0, 0.3, 1}, {1, 1, 1}}, {}}; }

// All but the second are clustered.
ModelAndState several_bodies() {
  std::vector<BodySetup> setups;
  for (const TriangleMesh& mesh :
       {generate_mesh("icosphere:3"), generate_mesh("cube:3"), generate_mesh("bowl:12"), sheet(), few_points()}) {
    BodySetup& setup = setups.emplace_back(body_of_mesh(mesh));
    setup.description.scale = 0.7;
    setup.description.position = glm::dvec3(3.0 * static_cast<double>(setups.size()), 0.5, 0);
  }
  return build_model(setups, glm::dvec3(0.0));
}

std::vector<std::optional<ListBasis>> bases_of(const Model& model) {
  std::vector<std::optional<ListBasis>> bases(model.bodies.size(), ListBasis{tested_accuracy});
  bases[1].reset();
  return bases;
}

std::vector<glm::dvec3> rest_positions_of(const Model& model, const ModelBody& body) {
  std::vector<glm::dvec3> rest;
  for (std::uint32_t i = 0; i < body.vertex_count; ++i) rest.push_back(model.rest_position(body.first_vertex + i));
  return rest;
}

std::vector<glm::dvec3> displacements_of(const State& state, const ModelBody& body) {
  std::vector<glm::dvec3> displacements;
  for (std::uint32_t i = 0; i < body.vertex_count; ++i) displacements.push_back(state.displacement(body.first_vertex + i));
  return displacements;
}

void deform(State& state, const Model& model, std::size_t number) {
  for (const ModelBody& body : model.bodies) {
    const bench::Deformation deformation = bench::deformations_of(rest_positions_of(model, body))[number];
    for (std::uint32_t i = 0; i < body.vertex_count; ++i)
      for (int k = 0; k < 3; ++k)
        state.motion[6 * (body.first_vertex + i) + static_cast<std::size_t>(k)] = deformation.displacements[i][k];
  }
}

struct Sums {
  std::vector<double> numbers;

  [[nodiscard]] glm::dvec3 force(const ModelBody& body, std::uint32_t i) const {
    const std::size_t at = 3 * (body.first_vertex + std::size_t{i});
    return -body.unit_of_length() * glm::dvec3(numbers[at], numbers[at + 1], numbers[at + 2]);
  }
};

// Fills what passes write before they read it with bytes that are not numbers.
void fill_with_rubbish(const Arrays& arrays) {
  for (const char* name : {"spring_point", "leaf_moment", "leaf_pull", "node_pull", "cluster_pull", "leaf_square"}) {
    const BufferId buffer = arrays.buffer(name);
    arrays.device().write(buffer, 0, std::vector<std::byte>(arrays.device().size_of(buffer), std::byte{0xff}));
  }
}

Sums sums_on(Device& device, const ModelAndState& start, bool only_stale = false) {
  DeviceBodies bodies(device, start.model, start.state);
  const Stepper stepper(bodies, start.model, find_integrator("verlet"), DampingLaw::none, 1e-3);
  ClusterTrees trees(2);
  const ClusterForces forces(bodies, start.model, bases_of(start.model), trees);
  fill_with_rubbish(bodies.arrays);
  device.run(stepper.first_passes());
  device.run(forces.passes(physics::start_slot, only_stale));
  return {bodies.arrays.get<double>("spring_sum").download()};
}

TEST_CASE("springs of clustered bodies are the same on every device and on the host", "[gl]") {
  ThreadPool pool(1);
  ModelAndState start = several_bodies();
  const std::vector<bench::Deformation> deformations =
      bench::deformations_of(rest_positions_of(start.model, start.model.bodies[0]));
  for (std::size_t d = 0; d < deformations.size(); ++d) {
    deform(start.state, start.model, d);
    for (const TestDevice& test : all_devices()) {
      const Sums sums = sums_on(*test.device, start);
      for (const ModelBody& body : start.model.bodies) {
        if (&body == &start.model.bodies[1]) continue;
        CAPTURE(deformations[d].name, test.name, body.first_vertex);
        const std::vector<glm::dvec3> exact = ClusterSprings(rest_positions_of(start.model, body), tested_accuracy)
                                                  .forces(pool, displacements_of(start.state, body));
        double error = 0, squared = 0, size = 0;
        glm::dvec3 all(0.0);
        for (std::uint32_t i = 0; i < body.vertex_count; ++i) {
          const glm::dvec3 force = sums.force(body, i);
          error += glm::dot(force - exact[i], force - exact[i]);
          squared += glm::dot(exact[i], exact[i]);
          size += glm::length(exact[i]);
          all += force;
        }
        const bool is_double = test.device->precision() == 64;
        // The strains of a turned body are a hundredth of its displacements, which are rounded.
        CHECK(std::sqrt(error / squared) < (is_double ? 1e-13 : deformations[d].name == "turned" ? 1e-5 : 5e-7));
        CHECK(glm::length(all) < (is_double ? 1e-14 : 1e-7) * size);
      }
    }
  }
}

TEST_CASE("springs of clustered bodies have the same bits on any number of threads, and in any order", "[gl]") {
  ModelAndState start = several_bodies();
  deform(start.state, start.model, 2);
  const auto numbers_on = [&](std::unique_ptr<Device> device) { return sums_on(*device, start).numbers; };
  const std::vector<double> one = numbers_on(make_cpu_device(1, 32));
  for (const unsigned threads : {2u, 7u}) CHECK(numbers_on(make_cpu_device(threads, 32)) == one);
  if (test::lacks_gl()) return;
  CHECK(numbers_on(make_gpu_device(0, ItemOrder::ascending)) == numbers_on(make_gpu_device(0, ItemOrder::descending)));
}

TEST_CASE("errors that a device measures are those of samples beside all springs", "[gl]") {
  ModelAndState start = several_bodies();
  std::vector<std::optional<ListBasis>> bases = bases_of(start.model);
  for (std::optional<ListBasis>& basis : bases)
    if (basis) basis->accuracy = 1e-6;
  for (const TestDevice& test : all_devices())
    for (const std::size_t d : {1u, 7u}) {  // smooth, and neighbours that move apart
      deform(start.state, start.model, d);
      DeviceBodies bodies(*test.device, start.model, start.state);
      const Stepper stepper(bodies, start.model, find_integrator("verlet"), DampingLaw::none, 1e-3);
      ClusterTrees trees(2);
      const ClusterForces forces(bodies, start.model, bases, trees);
      fill_with_rubbish(bodies.arrays);
      test.device->run(stepper.first_passes());
      test.device->run(forces.measuring_passes(physics::start_slot));
      const std::vector<ClusterErrors> errors = forces.errors();
      const std::vector<double> sums = bodies.arrays.get<double>("spring_sum").download();
      for (std::size_t b = 0; b < start.model.bodies.size(); ++b) {
        if (!bases[b]) continue;
        const ModelBody& body = start.model.bodies[b];
        ThreadPool pool(1);
        const std::vector<glm::dvec3> rest = rest_positions_of(start.model, body), moved = displacements_of(start.state, body);
        const bench::ExactForces exact(pool, rest, moved, body.vertex_count);
        const double error = exact.error_of([&](std::size_t i) {
          const double* const sum = &sums[3 * (body.first_vertex + i)];
          return -body.unit_of_length() * glm::dvec3(sum[0], sum[1], sum[2]);
        });
        CAPTURE(test.name, d, b, error);
        CHECK(errors[b].error / errors[b].sum < 2 * error + 1e-5);
        CHECK(errors[b].error / errors[b].sum > 0.5 * error - 1e-5);
        CHECK(errors[b].size > errors[b].sum * (1 - 1e-6));
        CHECK(errors[b].sum_of_all == Approx(errors[b].sum).epsilon(0.3));
        CHECK(errors[b].relative() >= errors[b].error / errors[b].sum);
      }
    }
  CHECK(ClusterErrors{}.relative() == 0);
  CHECK(std::isinf(ClusterErrors{.error = std::nan(""), .sum = 1, .size = 1, .handed_down = 1, .sum_of_all = 1}.relative()));
  CHECK(std::isinf(ClusterErrors{.error = 1, .sum = 0, .size = 1, .handed_down = 0, .sum_of_all = 1}.relative()));
  CHECK(ClusterErrors{.error = 1, .sum = 100, .size = 1, .handed_down = 1, .sum_of_all = 1}.relative() == 0.05);
}

// Sums of a leaf stand alone, so that those of bodies that are left out stay as they were.
TEST_CASE("springs of clustered bodies are summed again if a stage asks for it, or kept forces are stale", "[gl]") {
  ModelAndState start = several_bodies();
  deform(start.state, start.model, 2);
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    DeviceBodies bodies(*test.device, start.model, start.state);
    const Stepper stepper(bodies, start.model, find_integrator("verlet"), DampingLaw::none, 1e-3);
    ClusterTrees trees(2);
    const ClusterForces forces(bodies, start.model, bases_of(start.model), trees);
    test.device->run(stepper.first_passes());
    const BufferId pulls = bodies.arrays.buffer("leaf_pull");
    const auto bytes_after = [&](bool only_stale) {
      std::vector<std::byte> bytes(test.device->size_of(pulls));
      test.device->write(pulls, 0, bytes);
      test.device->run(forces.passes(physics::start_slot, only_stale));
      test.device->read(pulls, 0, bytes);
      return bytes;
    };
    const std::vector<std::byte> all = bytes_after(false);
    CHECK(bytes_after(true) == all);
    std::vector<physics::Status> statuses = bodies.statuses.download();
    statuses[0].force_stale = 0;
    statuses[2].deformed = 0;
    bodies.statuses.upload(statuses);
    const std::vector<std::byte> stale = bytes_after(true), some = bytes_after(false);
    std::size_t first = 0;
    for (std::size_t b = 0; b < start.model.bodies.size(); ++b) {
      if (b == 1) continue;  // it is not clustered
      const std::size_t leaves = (start.model.bodies[b].vertex_count + leaf_size - 1) / leaf_size;
      const std::size_t count = 3 * leaf_size * leaves * static_cast<std::size_t>(test.device->precision() / 8);
      const auto part_of = [&](const std::vector<std::byte>& of_all) {
        return std::vector(of_all.begin() + static_cast<std::ptrdiff_t>(first),
                           of_all.begin() + static_cast<std::ptrdiff_t>(first + count));
      };
      const std::vector<std::byte> none(count);
      CHECK(part_of(all) != none);
      CHECK(part_of(stale) == (b > 2 ? part_of(all) : none));
      CHECK(part_of(some) == (b == 2 ? none : part_of(all)));
      first += count;
    }
  }
}

}  // namespace
}  // namespace pliant
