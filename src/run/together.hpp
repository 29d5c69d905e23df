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

/// Thrown on ranks where nothing went wrong when it did on another one, which tells.
struct FailedElsewhere {};

/// Does this on all ranks, which must not wait for each other in it. If it throws on some, the first of them throws that, and all
/// others FailedElsewhere. Null: this rank is alone.
void do_together(Ranks* ranks, const std::function<void()>& work);

/// Returns the text of rank 0.
[[nodiscard]] std::string text_of_first(Ranks& ranks, std::string text);

/// The next two throw on all ranks if one differs from rank 0: there Error (device), elsewhere FailedElsewhere. The first
/// compares versions and options, before anything else is asked of the others. The second compares scenes, meshes, plans, and
/// devices, which have to compute the same bits and share work alike.
void expect_same_options(Ranks& ranks, const RunOptions& options);
void expect_same_runs(Ranks& ranks, const PreparedRun& run);

/// Makes steps on this rank, which is rank 0 or alone, and has all others make them, too.
class Leader {
 public:
  Leader(Simulation& simulation, Ranks* ranks) : simulation_(simulation), ranks_(ranks) {}
  /// These are the simulation's.
  void advance(std::uint64_t steps, const std::function<bool()>& stops);
  [[nodiscard]] StepReport advance_toward(double time);
  /// Throws as above unless all ranks have these bits.
  void compare(const State& state);
  /// Lets the others go.
  void end();

 private:
  Simulation& simulation_;
  Ranks* ranks_;
};

/// Makes the steps that rank 0 makes, until it says that the run is over.
void follow(Simulation& simulation, Ranks& ranks);

}  // namespace pliant
