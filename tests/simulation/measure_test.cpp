// Energies and momenta of a state against closed forms.
#include "simulation/measure.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "support/evolve.hpp"

namespace pliant {
namespace {

TEST_CASE("the elastic energy is half the stiffness times the squared elongations, of every spring of every body") {
  std::vector<BodySetup> setups{sphere(1), sphere(0)};
  setups[0].description.stretch = {1.3, 0.7, 1.01};
  setups[0].description.stiffness = 3;
  setups[1].description.stretch = {1, 1 + 1e-9, 1};  // a difference of lengths would keep seven digits here
  const auto [model, state] = build_model(setups, {0, 0, 0});
  const auto moved = state.world_positions(model);
  long double all = 0;
  for (std::uint32_t i = 0; i < model.vertex_count(); ++i) {
    for (std::uint32_t j = i + 1; j < model.vertex_count() && model.body_index(j) == model.body_index(i); ++j) {
      long double now = 0, rest = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const long double r = static_cast<long double>(model.rest_positions[i][axis]) - model.rest_positions[j][axis];
        const long double d = static_cast<long double>(state.motion[6 * i + static_cast<std::size_t>(axis)]) -
                              state.motion[6 * j + static_cast<std::size_t>(axis)];
        now += (r + d) * (r + d);
        rest += r * r;
      }
      const long double elongation = std::sqrt(now) - std::sqrt(rest);
      all += static_cast<long double>(0.5 * model.body_of(i).stiffness) * elongation * elongation;
    }
  }
  for (const unsigned threads : {1u, 3u}) {
    ThreadPool pool(threads);
    CHECK(measure(model, state, {0, 0, 0}, pool).elastic == Approx(static_cast<double>(all)).epsilon(1e-13));
  }
}

TEST_CASE("vertices that share a place have a finite energy") {
  ThreadPool pool(1);
  BodySetup twins = two_vertices();
  const auto elastic = [&] {
    const ModelAndState start = built(twins);
    return measure(start.model, start.state, {0, 0, 0}, pool).elastic;
  };
  twins.description.stretch = {0, 1, 1};  // of a spring 1 m long, k = 1
  CHECK(elastic() == Approx(0.5));
  twins.mesh.positions = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}};
  twins.description.stretch = {1, 1, 1};
  CHECK(elastic() == 0);
}

TEST_CASE("the energy of a spring is right up to lengths whose square can hardly be told") {
  ThreadPool pool(1);
  ModelAndState start = built(two_vertices());
  for (const double length : {1e30, 1e77, 1e100, 1e150}) {
    CAPTURE(length);
    start.state.motion[6] = length;
    CHECK(measure(start.model, start.state, {0, 0, 0}, pool).elastic == Approx(0.5 * length * length).epsilon(1e-14));
  }
}

TEST_CASE("a measurement that is stopped knows no elastic energy, and all the rest") {
  BodySetup setup = sphere(1);
  setup.description.velocity = {3, 0, 0};
  const ModelAndState start = built(setup);
  ThreadPool pool(2);
  const Measurement whole = measure(start.model, start.state, {0, 0, 0}, pool, [] { return false; });
  const Measurement stopped = measure(start.model, start.state, {0, 0, 0}, pool, [] { return true; });
  CHECK(whole.elastic == 0);
  CHECK(std::isnan(stopped.elastic));
  CHECK(stopped.kinetic == whole.kinetic);
  CHECK(whole.kinetic == Approx(0.5 * 42 * 9));
}

// A body that is deformed, one that is not, one that stands, and one that falls into several tasks.
ModelAndState four_bodies() {
  std::vector<BodySetup> setups{sphere(1), sphere(0), sphere(0), sphere(2)};
  setups[0].description.stretch = {1.3, 0.7, 1.01};
  setups[2].description.kind = BodyKind::immovable;
  setups[3].description.stretch = {0.9, 1, 1};
  setups[3].description.velocity = {3, 0, -1};
  return build_model(setups, {0, -9.81, 0});
}

// Measurements are the same if their bits are. NaNs do not turn up.
void check_same(const Measurement& a, const Measurement& b) {
  CHECK(a.kinetic == b.kinetic);
  CHECK(a.elastic == b.elastic);
  CHECK(a.gravitational == b.gravitational);
  CHECK(a.momentum == b.momentum);
  CHECK(a.angular_momentum == b.angular_momentum);
}

TEST_CASE("a meter that has measured other states gives the bits of one that has not, on any number of threads") {
  auto [model, state] = four_bodies();
  const glm::dvec3 down(0, -9.81, 0);
  ThreadPool alone(1), pool(3);
  Meter meter(model);
  double before = meter.measure(state, down, pool).elastic;
  for (const ModelBody& body : model.bodies)
    for (const std::uint32_t vertex : {0u, body.vertex_count / 2, body.vertex_count - 1})
      for (const std::uint32_t number : {0u, 1u, 2u, 5u}) {
        CAPTURE(body.first_vertex, vertex, number);
        state.motion[physics::motion_size * (body.first_vertex + vertex) + number] += 1e-6;
        const Measurement measured = meter.measure(state, down, pool);
        check_same(measured, measure(model, state, down, alone));
        CHECK((measured.elastic == before) == (body.is_rigid() || number == 5));  // the last numbers are velocities
        before = measured.elastic;
      }
  state.poses[0].origin[1] += 1;
  check_same(meter.measure(state, down, pool), measure(model, state, down, alone));
}

TEST_CASE("a meter sums no springs of bodies that keep their places in their frames, and all others") {
  auto [model, state] = four_bodies();
  const glm::dvec3 down(0, -9.81, 0);
  const auto stop = [] { return true; };
  ThreadPool pool(2);
  Meter meter(model);
  CHECK(std::isnan(meter.measure(state, down, pool, stop).elastic));
  const Measurement whole = meter.measure(state, down, pool);
  check_same(meter.measure(state, down, pool, stop), whole);  // though it may sum none
  state.motion.back() += 1;
  CHECK(meter.measure(state, down, pool, stop).elastic == whole.elastic);
  state.motion.front() = std::nextafter(state.motion.front(), 1.0);
  CHECK(std::isnan(meter.measure(state, down, pool, stop).elastic));
  check_same(meter.measure(state, down, pool), measure(model, state, down, pool));
}

}  // namespace
}  // namespace pliant
