// Lists of contacts are in no fixed order, and a kick must not depend on it.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>
#include <random>

#include "mesh/generators.hpp"
#include "physics/contact/surface.glsl"
#include "support/device_bench.hpp"
#include "support/has.hpp"

namespace pliant {
namespace {

// Cubes in pairs far from each other. Of each pair two edges cross, a little above the gap, so that a pair has one contact with
// four vertices.
ModelAndState pairs_of_cubes(int pairs) {
  const double half_diagonal = std::sqrt(0.5);
  std::vector<BodySetup> setups;
  for (int k = 0; k < 2 * pairs; ++k) {
    const bool above = k % 2 == 1;
    BodySetup cube = sphere(0);
    cube.mesh = generate_mesh("cube:1");
    const glm::dvec3 axis(above ? 1 : 0, 0, above ? 0 : 1);
    for (glm::dvec3& p : cube.mesh.positions)
      p = glm::dvec3(glm::rotate(glm::dmat4(1), glm::radians(45.0), axis) * glm::dvec4(p, 1));
    cube.description.name = fmt::format("cube {}", k);
    cube.description.position = {4.0 * (k / 2 % 12), above ? 2 * half_diagonal + 0.06 : 0, 4.0 * (k / 24)};
    cube.description.velocity = {0, above ? -1 - 0.01 * k : 0.5, 0};
    setups.push_back(cube);
  }
  return build_model(setups, {0, 0, 0});
}

// Puts the contacts of the list into another order.
void shuffle_contacts(Bench& bench, unsigned seed) {
  const Arrays& arrays = bench.bodies.arrays;
  std::vector<std::uint32_t> order(contact_count(bench));
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::shuffle(order, std::mt19937(seed));
  const auto reorder = [&]<class Element>(std::string_view array, std::size_t elements, Element) {
    const auto before = bench.read<Element>(arrays.buffer(array));
    std::vector<Element> after = before;
    for (std::size_t c = 0; c < order.size(); ++c)
      std::copy_n(before.begin() + static_cast<std::ptrdiff_t>(elements * order[c]), elements,
                  after.begin() + static_cast<std::ptrdiff_t>(elements * c));
    bench.device->write(arrays.buffer(array), 0, std::as_bytes(std::span(after)));
  };
  reorder("contact_vertex", 1, glm::uvec4());
  reorder("contact", 4 * physics::contact_rows, float());
  reorder("contact_impulse", 4, float());
}

// Two cubes with a face on a face, turned a little. Their vertices share contacts.
ModelAndState cube_on_cube(int cells) {
  std::vector<BodySetup> setups;
  for (const bool is_above : {false, true}) {
    BodySetup cube = sphere(0);
    cube.mesh = generate_mesh(fmt::format("cube:{}", cells));
    cube.description.name = is_above ? "above" : "below";
    if (is_above) {
      cube.description.position = {0.1, 1.003, 0};
      cube.description.rotation = {0, 20, 0};
      cube.description.velocity = {0.2, -1, 0};
    }
    setups.push_back(cube);
  }
  return build_model(setups, {0, 0, 0});
}

// Makes a step from the start several times, with contacts in other orders. Returns how many were listed.
std::uint32_t check_order_of_contacts(const ModelAndState& start) {
  std::uint32_t contacts = 0;
  std::vector<std::vector<double>> motions;
  for (unsigned seed = 0; seed < 3; ++seed) {
    Bench gpu(make_gpu_device(0), start, {"verlet", 0.02}, {.response = {"impulse"}});
    gpu.begin();
    for (const Pass& pass : gpu.step(0)) {
      if (pass.name == "solve_contacts" && seed > 0) shuffle_contacts(gpu, seed);
      gpu.device->run({&pass, 1});
    }
    contacts = contact_count(gpu);
    motions.push_back(gpu.bodies.motions.download());
    CHECK(motions.back() == motions.front());
  }
  return contacts;
}

// A GPU's work group with 48 KB of memory serves up to 565 vertices alone, and one with 32 KB up to 377.
TEST_CASE("the order of contacts does not matter, however many vertices they have", "[gl]") {
  if (test::lacks_gl()) return;
  const int pairs = GENERATE(94, 95, 106, 107, 141, 142, 160);
  CAPTURE(pairs);
  CHECK(check_order_of_contacts(pairs_of_cubes(pairs)) == static_cast<std::uint32_t>(pairs));
}

TEST_CASE("the order of contacts that share vertices does not matter", "[gl]") {
  if (test::lacks_gl()) return;
  const int cells = GENERATE(4, 14);  // one work group can keep the contacts in its own memory, or not
  CAPTURE(cells);
  const std::uint32_t contacts = check_order_of_contacts(cube_on_cube(cells));
  CHECK(contacts > 25);
  CHECK((contacts > 512) == (cells == 14));
}

}  // namespace
}  // namespace pliant
