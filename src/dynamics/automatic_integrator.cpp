#include "dynamics/automatic_integrator.hpp"

#include <algorithm>

#include "core/expect.hpp"

namespace pliant {
namespace {

struct Choice {
  DampingLaw law;
  double least_tolerance;
  std::string_view integrator;
};

// The method is that of the first row whose law is the scene's and whose least tolerance is not above the scene's. Rows were
// chosen by force evaluations at equal true error of squashed spheres (docs/accuracy.md, "What a tolerance costs"):
// - Without damping dprkn12 needs the fewest. From 1e-4 on dprkn8 hardly needs more, and its steps are the cheapest where
//   contacts bound them.
// - The adaptive law has a kink. High orders are lost there, and verner78_8's milder estimate pays.
// - The internal law is as smooth as the constant one.
// - vern8 is for fp64, because its weights magnify what fp32 rounds.
// clang-format off
constexpr Choice choices[] = {
    {DampingLaw::none, 1e-4, "dprkn8"},
    {DampingLaw::none, 0, "dprkn12"},
    {DampingLaw::constant, 1e-7, "dop853"},
    {DampingLaw::constant, 0, "vern8"},
    {DampingLaw::adaptive, 0, "verner78_8"},
    {DampingLaw::internal, 1e-7, "dop853"},
    {DampingLaw::internal, 0, "vern8"},
};
// clang-format on

}  // namespace

const Integrator& automatic_integrator(double tolerance, DampingLaw law) {
  const auto fits = [&](const Choice& choice) { return choice.law == law && tolerance >= choice.least_tolerance; };
  const auto* choice = std::ranges::find_if(choices, fits);
  PLIANT_EXPECT(choice != std::end(choices));
  return find_integrator(choice->integrator);
}

}  // namespace pliant
