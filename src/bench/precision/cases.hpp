// What the suite `precision` integrates, and how far from the truth an end is.
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
  bool with_peers = true;             // one body without contacts
  bool with_tolerances = true;        // without contacts
  bool is_contest = false;            // smooth: where the suite's claim is judged

  [[nodiscard]] TimePlan plan_steps(const Integrator& integrator, std::uint64_t steps) const;
  /// As plan_time() has it for a scene, but that no frame holds a step back.
  [[nodiscard]] TimePlan plan_tolerance(const Integrator& integrator, double tolerance) const;
  /// Up to which the method is stable; 1 / omega where nothing bounds it [s].
  [[nodiscard]] double largest_step(const Integrator& integrator) const;
};

struct PrecisionCases {
  std::vector<PrecisionCase> cases;
  std::vector<std::string> notes;  // what was left out, and why
};

/// `scenes`: folder for the bunny; without bunnies_undamped.toml there it is left out. `quick`: fewer vertices, shorter.
[[nodiscard]] PrecisionCases make_precision_cases(const std::filesystem::path& scenes, bool quick);

/// World positions [m] and velocities [m/s].
struct Ending {
  std::vector<glm::dvec3> positions, velocities;
};

[[nodiscard]] Ending ending_of(const Model& model, const State& state);

/// L2 norm of the difference over (x, v / omega), relative to that of the reference's own deformation: what its bodies'
/// translation leaves. NaN where an ending is not finite.
[[nodiscard]] double relative_error(const PrecisionCase& what, const Ending& reference, const Ending& ending);

}  // namespace pliant::bench
