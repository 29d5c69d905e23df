#include "app/run_command.hpp"

#include <fmt/format.h>

#include "app/failures.hpp"
#include "app/mpi_ranks.hpp"
#include "run/together.hpp"

namespace pliant::app {
namespace {

int run_as_rank(const RunOptions& options) {
  const std::unique_ptr<MpiRanks> ranks = join_ranks();
  if (options.check) return ranks->number() == 0 ? run_scene(options) : 0;  // it is about this machine
  try {
    return run_scene(options, ranks.get());
  } catch (const FailedElsewhere& failure) {
    return failure.exit_code;
  } catch (...) {
    const int code = tell_failure(ranks->number() == 0 ? "pliant" : fmt::format("pliant: rank {}", ranks->number()));
    if (ranks->is_abandoned()) ranks->end_all(code);
    return code;
  }
}

}  // namespace

int run(const RunOptions& options) { return is_a_rank() ? run_as_rank(options) : run_scene(options); }

}  // namespace pliant::app
