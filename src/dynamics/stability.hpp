// How long a step a method bears on the oscillator x'' = -omega^2 x - g x', and so on a body's stiffest mode.
#pragma once
#include <vector>

#include "dynamics/integrator.hpp"
#include "model/model.hpp"
#include "scene/scene_description.hpp"

namespace pliant {

/// R's coefficients, constant term first: one step on y' = lambda y multiplies y by R(h lambda).
[[nodiscard]] std::vector<double> stability_polynomial(const RungeKutta& method);

/// Of energy, against the start's: the sign of a body blown up. Strained bounds (Integrator::strained_bound) are measured by it.
/// The energy of a stable splitting swings by as much at 0.95 of its bound; where a squashed body's vertices pass through one
/// another, a single step of any length can multiply the energy a few times.
inline constexpr double blow_up_growth = 10;

/// By what factor a step of omega_step / omega multiplies the amplitude of x'' = -omega^2 x. Expects no splitting.
[[nodiscard]] double undamped_amplification(const Integrator& integrator, double omega_step);

/// The step h [s] up to which one step amplifies no more than 1 + 1e-4, for every damping rate g from 0 to
/// damping_rate_max and both solutions lambda of lambda^2 + g lambda + omega_squared = 0. Infinite where nothing bounds it.
/// A slower mode can bear less where g is near omega or above; that of omega_squared = 0, a body drifting through a
/// damping medium, needs a call of its own. A Nystrom method bears with any rate what it bears without, as far as
/// drag_bound goes. Damping expects allows_damping(integrator, DampingLaw::constant).
[[nodiscard]] double step_bound(const Integrator& integrator, double omega_squared /* [1/s^2] */,
                                double damping_rate_max /* [1/s] */);

/// The same for a body: of its stiffest mode, and of its own translation, which springs do not hold back.
[[nodiscard]] double step_bound(const Integrator& integrator, const ModelBody& body, DampingLaw law);

/// The step [s] up to which a Nystrom method, whose weights hold the damping, lets a body drift as far as drag does: one step of
/// motion by drag and gravity alone is wrong by at most 1e-4. Longer ones stop it short, and weights overflow in the end.
/// Infinite for other methods.
[[nodiscard]] double drag_bound(const Integrator& integrator, const ModelBody& body, DampingLaw law);

/// Angular frequency of the body's stiffest small motion [1/s], and its square: what the forces add to it, at most.
[[nodiscard]] double stiffest_frequency_squared(const ModelBody& body);
[[nodiscard]] double stiffest_frequency(const ModelBody& body);

/// The largest damping rate g that the law can give the body [1/s].
[[nodiscard]] double largest_damping_rate(const ModelBody& body, DampingLaw law);

}  // namespace pliant
