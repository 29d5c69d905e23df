// Ranks that MPI has started, by mpirun or the like.
#pragma once
#include <memory>

#include "ranks/ranks.hpp"

namespace pliant::app {

/// Whether MPI has started this process as one of several.
[[nodiscard]] bool is_a_rank();

class MpiRanks : public Ranks {
 public:
  /// Ends this process and all other ranks. If MPI does not do so, this process ends at least.
  [[noreturn]] virtual void end_all(int exit_code) = 0;
  [[nodiscard]] virtual bool have_agreed_to_end() const = 0;
};

/// Joins the others, once in the life of a process. Errors of MPI end all ranks, and it tells of them. When what is returned
/// goes, it waits for the others. Throws Error (device) if this program was built without MPI.
[[nodiscard]] std::unique_ptr<MpiRanks> join_ranks();

}  // namespace pliant::app
