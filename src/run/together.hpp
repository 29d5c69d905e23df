// Runs that several ranks make together. Rank 0 leads: it alone writes, and decides how many steps to make and when to stop. The
// others follow.
#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "ranks/ranks.hpp"
#include "run/prepared_run.hpp"
#include "simulation/simulation.hpp"

namespace pliant {

/// Thrown on ranks where nothing went wrong when something did on another one, which tells.
struct FailedElsewhere {
  int exit_code;
};

/// Does this on all ranks, which must not wait for each other in it. If it throws on some, the first of them throws that, and all
/// others FailedElsewhere. A null is one rank alone.
void do_together(Ranks* ranks, const std::function<void()>& work);

/// Returns the text of rank 0.
[[nodiscard]] std::string text_of_first(Ranks& ranks, std::string text);

/// Throws Error (device) unless all ranks have the same scene, the same meshes and devices that compute the same bits.
void expect_same(Ranks& ranks, const PreparedRun& run);

/// Makes steps on this rank, which is rank 0 or alone, and has all others make them, too.
class Leader {
 public:
  Leader(Simulation& simulation, Ranks* ranks) : simulation_(simulation), ranks_(ranks) {}
  /// These are the simulation's.
  void advance(std::uint64_t steps, const std::function<bool()>& stops);
  [[nodiscard]] StepReport advance_toward(double time);
  /// Throws Error (device) unless all ranks have these bits.
  void compare(const State& state);
  /// Lets the others go, with this exit code.
  void end(int exit_code);

 private:
  Simulation& simulation_;
  Ranks* ranks_;
};

/// Makes the steps that rank 0 makes. Returns its exit code.
[[nodiscard]] int follow(Simulation& simulation, Ranks& ranks);

}  // namespace pliant
