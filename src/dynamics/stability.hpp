// Says how long a step a method bears on the oscillator x'' = -omega^2 x - g x', and so on a body's stiffest mode.
#pragma once
#include <vector>

#include "dynamics/integrator.hpp"
#include "model/model.hpp"
#include "scene/scene_description.hpp"

namespace pliant {

/// Returns the coefficients of the polynomial R, constant term first. One step on y' = lambda y multiplies y by R(h lambda).
[[nodiscard]] std::vector<double> stability_polynomial(const RungeKutta& method);

/// A body counts as blown up when its energy is this many times that of the start. Strained bounds (Integrator::strained_bound)
/// are measured by it. The energy of a stable splitting swings by as much at 0.95 of its bound. Where a squashed body's vertices
/// pass through one another, a single step of any length can multiply the energy a few times.
inline constexpr double blow_up_growth = 10;

/// Returns the factor by which a step of omega_step / omega multiplies the amplitude of x'' = -omega^2 x. Expects no splitting.
[[nodiscard]] double undamped_amplification(const Integrator& integrator, double omega_step);

/// Returns the step h [s] up to which one step amplifies no more than 1 + 1e-4, or infinity if nothing bounds it. That holds for
/// every damping rate g from 0 to damping_rate_max and both solutions lambda of lambda^2 + g lambda + omega_squared = 0.
/// A slower mode can bear less if g is near omega or above. The mode of omega_squared = 0 needs a call of its own: a body that
/// drifts through a damping medium.
/// Damping does not change the bound of a Nystrom method, but drag_bound limits its steps as well. Expects
/// allows_damping(integrator, DampingLaw::constant) if there is damping.
[[nodiscard]] double step_bound(const Integrator& integrator, double omega_squared /* [1/s^2] */,
                                double damping_rate_max /* [1/s] */);

/// Returns the same for a body: the smaller bound of its stiffest mode and its own translation, which springs do not hold back.
[[nodiscard]] double step_bound(const Integrator& integrator, const ModelBody& body, DampingLaw law);

/// Returns the step [s] up to which a Nystrom method, whose weights hold the damping, lets a body drift as far as drag does. Up
/// to it, one step of motion by drag and gravity alone is wrong by at most 1e-4. Longer ones stop the body short, and weights
/// overflow in the end. Returns infinity for other methods and without damping.
[[nodiscard]] double drag_bound(const Integrator& integrator, const ModelBody& body, DampingLaw law);

/// Return the angular frequency of the body's stiffest small motion [1/s], and its square [1/s^2]. The square is the sum of what
/// the forces add to it at most.
[[nodiscard]] double stiffest_frequency_squared(const ModelBody& body);
[[nodiscard]] double stiffest_frequency(const ModelBody& body);

/// Returns the largest damping rate g that the law can give the body [1/s].
[[nodiscard]] double largest_damping_rate(const ModelBody& body, DampingLaw law);

}  // namespace pliant
