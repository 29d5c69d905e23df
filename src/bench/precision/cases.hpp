// Makes the cases of the suite `precision`, and measures how far an end is from the truth.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "dynamics/integrator.hpp"
#include "model/model.hpp"
#include "simulation/time_plan.hpp"

namespace pliant::bench {

struct PrecisionCase {
  std::string name;
  ModelAndState start;
  DampingLaw damping_law = DampingLaw::none;
  CollisionDescription collision;
  double duration = 0;                // [s]
  double omega = 0;                   // of the stiffest body's breathing, sqrt(N k / m) [rad/s]
  std::uint64_t reference_steps = 0;  // of the coarser reference
  bool with_peers = true;             // other libraries take part: one body without contacts
  bool with_tolerances = true;        // steps by a tolerance take part: no contacts
  bool is_contest = false;            // a smooth case, which counts in the comparison with other libraries

  [[nodiscard]] TimePlan plan_steps(const Integrator& integrator, std::uint64_t steps) const;
  /// Returns the same plan as plan_time() for a scene, except that frames do not bound steps.
  [[nodiscard]] TimePlan plan_tolerance(const Integrator& integrator, double tolerance) const;
  /// Returns the longest stable step [s], or 1 / omega if nothing bounds it.
  [[nodiscard]] double largest_step(const Integrator& integrator) const;
};

struct PrecisionCases {
  std::vector<PrecisionCase> cases;
  std::vector<std::string> notes;  // what was left out, and why
};

/// Makes the cases. The bunny comes from bunnies_undamped.toml in the folder `scenes`, and is left out if that is missing. With
/// `quick` the cases have fewer vertices and are shorter.
[[nodiscard]] PrecisionCases make_precision_cases(const std::filesystem::path& scenes, bool quick);

/// World positions [m] and velocities [m/s].
struct Ending {
  std::vector<glm::dvec3> positions, velocities;
};

[[nodiscard]] Ending ending_of(const Model& model, const State& state);

/// Returns the L2 norm of the difference over (x, v / omega), relative to the norm of the reference's deformation. The
/// deformation is the reference without its bodies' translation. Returns NaN if an ending is not finite.
[[nodiscard]] double relative_error(const PrecisionCase& what, const Ending& reference, const Ending& ending);

}  // namespace pliant::bench
