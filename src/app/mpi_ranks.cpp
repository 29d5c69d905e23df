// The only file that sees MPI.
#include "app/mpi_ranks.hpp"

#include <cstdlib>
#include <string>

#ifdef PLIANT_MPI
#define OMPI_SKIP_MPICXX  // pliant uses the interface for C
#define MPICH_SKIP_MPICXX
#include <mpi.h>

#include <deque>
#include <vector>
#endif

#include "core/error.hpp"

namespace pliant::app {
namespace {

bool is_more_than_one(const char* count) { return count != nullptr && std::strtol(count, nullptr, 10) > 1; }

#ifdef PLIANT_MPI
class World final : public MpiRanks {
 public:
  World() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);  // threads of pools do not call MPI
    MPI_Comm_rank(all_, &number_);
    MPI_Comm_size(all_, &count_);
    if (count_ == 1) {
      MPI_Finalize();
      throw Error(
          ErrorKind::device, "MPI", "what started this rank is of another MPI than this pliant",
          "start it by the mpirun of the MPI that it was built with, or unset OMPI_COMM_WORLD_SIZE, PMI_SIZE and PMIX_RANK "
          "for a run of its own");
    }
    MPI_Comm here = MPI_COMM_NULL;
    MPI_Comm_split_type(all_, MPI_COMM_TYPE_SHARED, number_, MPI_INFO_NULL, &here);
    MPI_Comm_rank(here, &number_here_);
    MPI_Comm_size(here, &count_here_);
    MPI_Comm_free(&here);
  }
  ~World() override { MPI_Finalize(); }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  std::size_t number() const override { return static_cast<std::size_t>(number_); }
  std::size_t count() const override { return static_cast<std::size_t>(count_); }
  std::size_t number_here() const override { return static_cast<std::size_t>(number_here_); }
  std::size_t count_here() const override { return static_cast<std::size_t>(count_here_); }

  void take_from_first(std::span<std::byte> bytes) override {
    constexpr std::size_t most = 1 << 30;  // MPI counts by int
    for (; bytes.size() > most; bytes = bytes.subspan(most)) MPI_Bcast(bytes.data(), most, MPI_BYTE, 0, all_);
    MPI_Bcast(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, 0, all_);
  }

  std::vector<std::uint64_t> hear_all(std::uint64_t mine) override {
    std::vector<std::uint64_t> said(count());
    MPI_Allgather(&mine, 1, MPI_UINT64_T, said.data(), 1, MPI_UINT64_T, all_);
    return said;
  }

  void begin_sharing(std::span<double> all, std::span<const NumberRange> ranges) override {
    Sharing& sharing = on_their_way_.emplace_back();
    for (const NumberRange& range : ranges) {
      sharing.counts.push_back(static_cast<int>(range.count));
      sharing.places.push_back(static_cast<int>(range.first));
    }
    MPI_Iallgatherv(MPI_IN_PLACE, 0, MPI_DOUBLE, all.data(), sharing.counts.data(), sharing.places.data(), MPI_DOUBLE, all_,
                    &sharing.request);
  }

  void go_on() override {
    for (Sharing& sharing : on_their_way_) {
      int has_ended = 0;
      MPI_Test(&sharing.request, &has_ended, MPI_STATUS_IGNORE);
    }
  }

  void end_sharing() override {
    MPI_Wait(&on_their_way_.front().request, MPI_STATUS_IGNORE);
    on_their_way_.pop_front();
  }

  void agree_to_end() override { have_agreed_ = true; }
  bool have_agreed_to_end() const override { return have_agreed_; }
  void end_all(int exit_code) override {
    MPI_Abort(all_, exit_code);
    std::_Exit(exit_code);
  }

 private:
  struct Sharing {
    std::vector<int> counts, places;  // MPI reads them until the end
    MPI_Request request = MPI_REQUEST_NULL;
  };

  MPI_Comm all_ = MPI_COMM_WORLD;
  int number_ = 0, count_ = 1, number_here_ = 0, count_here_ = 1;
  std::deque<Sharing> on_their_way_;
  bool have_agreed_ = false;
};
#endif

}  // namespace

// A process that nobody started as a rank may not ask MPI, which would take time to find out that it is alone. Open MPI's mpirun
// tells the number of ranks, also within a job of Slurm with more tasks. MPICH's does, and so does srun with PMI-2 or PMIx.
bool is_a_rank() {
  if (const char* count = std::getenv("OMPI_COMM_WORLD_SIZE")) return is_more_than_one(count);
  if (const char* count = std::getenv("PMI_SIZE")) return is_more_than_one(count);
  return std::getenv("PMIX_RANK") != nullptr && is_more_than_one(std::getenv("SLURM_NTASKS"));
}

std::unique_ptr<MpiRanks> join_ranks() {
#ifdef PLIANT_MPI
  return std::make_unique<World>();
#else
  throw Error(
      ErrorKind::device, "MPI", "has started several ranks, and this pliant was built without it",
      "build it where libopenmpi-dev is installed, or unset OMPI_COMM_WORLD_SIZE, PMI_SIZE and PMIX_RANK for runs of their own");
#endif
}

}  // namespace pliant::app
