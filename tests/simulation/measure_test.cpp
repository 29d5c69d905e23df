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

}  // namespace
}  // namespace pliant
