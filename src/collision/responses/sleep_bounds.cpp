#include "collision/responses/sleep_bounds.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "physics/contact/surface.glsl"

namespace pliant {
namespace {

// A body may sleep that moves by less than so many diameters of the smallest one a second.
constexpr double sleep_diameters = 0.05;

// Of bodies that move [m].
double smallest_diameter(const Model& model) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const ModelBody& body : model.bodies)
    if (!body.is_rigid()) smallest = std::min(smallest, 2 * body.radius);
  return smallest;
}

}  // namespace

double sleep_speed(const Model& model, double gravity) {
  const double by_size = sleep_diameters * smallest_diameter(model), gained = 0.1 * gravity * physics::sleeps_after;
  return gravity > 0 ? std::min(by_size, gained / 2) : by_size;
}

// What slides or falls with a tenth of gravity, a, can't stay so near for the time T that it takes to fall asleep. It stays
// nearest if it first goes up for a time t, by a t^2 / 2, and ends as far below: a T^2 / 2 - a t T = a t^2 / 2. Then
// t = (sqrt(2) - 1) T.
double sleep_way(const Model& model, double gravity) {
  const double T = physics::sleeps_after;
  const double by_size = sleep_diameters * smallest_diameter(model) * T;
  const double turn = (std::numbers::sqrt2 - 1) * T, by_gravity = 0.1 * gravity * turn * turn / 2;
  return gravity > 0 ? std::min(by_size, by_gravity) : by_size;
}

}  // namespace pliant
