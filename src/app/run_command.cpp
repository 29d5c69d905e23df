#include "app/run_command.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "app/failures.hpp"
#include "app/mpi_ranks.hpp"
#include "run/together.hpp"

namespace pliant::app {
namespace {

int run_as_rank(const RunOptions& options) {
  const std::unique_ptr<MpiRanks> ranks = join_ranks();
  int code = 0;
  try {
    code = run_scene(options, ranks.get());
  } catch (const FailedElsewhere&) {
    return 0;
  } catch (...) {
    code = tell_failure(ranks->number() == 0 ? "pliant" : fmt::format("pliant: rank {}", ranks->number()));
    std::fflush(stdout);
    if (!ranks->have_agreed_to_end()) ranks->end_all(code);
  }
  std::fflush(stdout);  // before others end, because mpirun ends all when one has failed
  return code;
}

}  // namespace

int run(const RunOptions& options) { return is_a_rank() ? run_as_rank(options) : run_scene(options); }

}  // namespace pliant::app
