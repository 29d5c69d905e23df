// `pliant run` on several ranks, which mpirun starts.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/read_text.hpp"
#include "device/cpu/isa.hpp"
#include "support/checkpointed_runs.hpp"
#include "support/has.hpp"
#include "support/paths.hpp"
#include "support/program.hpp"
#include "support/scratch.hpp"

namespace pliant {
namespace {

using test::ScratchFolder;

// Whether the program was built with MPI, and there is an mpirun.
bool has_mpi() {
#ifdef PLIANT_MPI
  return std::system("command -v mpirun > /dev/null") == 0;
#else
  return false;
#endif
}

bool lacks_mpi() { return test::lacks("MPI", has_mpi()); }

// Open MPI serves root, and more ranks than processors, only if it is told so. Ranks that wait for each other give way then. All
// ranks are on this machine, where ssh may be missing, and processes may not be allowed to read each other's memory.
const std::string mpirun =
    "env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe --mca plm isolated "
    "--mca btl_vader_single_copy_mechanism none ";

std::string on(int ranks) { return mpirun + "-n " + std::to_string(ranks) + " "; }

int count_of(const std::string& part, const std::string& text) {
  int count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

void check_same_results(const std::filesystem::path& a, const std::filesystem::path& b) {
  for (const char* name : {"final_state.csv", "history.csv"}) CHECK(read_text(a / name) == read_text(b / name));
}

void check_two_ranks(const std::string& device) {
  CAPTURE(device);
  const ScratchFolder folder;
  const std::string scene = test::scene_in(folder, "time_step = 0.002\nduration = 0.08", "icosphere:3").string();
  const auto alone = folder.path / "alone", together = folder.path / "together";
  const std::string run = "run " + scene + " --frames ply --device " + device + " --out ";
  REQUIRE(run_program(run + alone.string()).exit_code == 0);
  const auto told = run_program(run + together.string(), on(2));
  CAPTURE(told.output);
  REQUIRE(told.exit_code == 0);
  CHECK(count_of("summary: ", told.output) == 1);
  CHECK_THAT(told.output, Catch::Contains(", 2 ranks\n"));
  check_same_results(alone, together);
  CHECK(read_text(alone / "frames/frame_0003.ply") == read_text(together / "frames/frame_0003.ply"));
  const auto account = [](const std::filesystem::path& of) {
    auto summary = test::account_in(of);
    for (const char* key : {"ranks", "threads", "warnings", "skipped"}) summary = summary.without(key);
    return summary;
  };
  CHECK(account(alone) == account(together));
  CHECK(test::account_in(together)["ranks"] == 2);
}

TEST_CASE("two ranks give the files of one, and say how many they were") {
  if (lacks_mpi()) return;
  for (const char* device : {"cpu", "cpu --precision 64"}) check_two_ranks(device);
}

TEST_CASE("two ranks on GPUs give the files of one", "[gl]") {
  if (!has_mpi()) return test::skip("there is no MPI");  // where tests of GPUs run there may be no mpirun
  if (test::lacks_gl()) return;
  check_two_ranks("gpu");
}

// A limit of the time that a process may take from its processor kills it in the midst of its steps.
TEST_CASE("a rank that is killed ends all, and the checkpoint goes on with another number of ranks") {
  if (lacks_mpi()) return;
  const ScratchFolder folder;
  const std::string scene = test::scene_in(folder, "time_step = 0.002\nduration = 4", "icosphere:3").string();
  const auto alone = folder.path / "alone", together = folder.path / "together";
  const std::string checkpoint = (folder.path / "run.checkpoint").string();
  REQUIRE(run_program("run " + scene + " --device cpu --threads 1 --quiet --out " + alone.string()).exit_code == 0);
  const std::string run = " run " + scene + " --device cpu --threads 1 --checkpoint-every 0 --checkpoint " + checkpoint +
                          " --out " + together.string();
  const std::string program = program_path();
  const auto killed = run_program(run, mpirun + "-n 1 sh -c 'ulimit -t 1; exec " + program + run + "' : -n 1 ");
  CAPTURE(killed.output);
  CHECK(killed.exit_code != 0);
  CHECK_THAT(killed.output, Catch::Contains("rank 0") && Catch::Contains("exited on signal"));
  CHECK(!std::filesystem::exists(together / "summary.json"));
  const auto resumed = run_program("run --quiet --resume " + checkpoint, on(3));
  CAPTURE(resumed.output);
  REQUIRE(resumed.exit_code == 0);
  check_same_results(alone, together);
}

TEST_CASE("what is wrong for all ranks is told once") {
  if (lacks_mpi()) return;
  const ScratchFolder folder;
  const auto missing = run_program("run " + (folder.path / "none.toml").string(), on(2));
  CHECK(missing.exit_code == 3);
  CHECK(count_of("can't be opened", missing.output) == 1);
  const std::string scene = test::scene_in(folder, test::verlet).string();
  const auto wrong = run_program("run " + scene + " --device cpu --precision 64 --gpu 0", on(2));
  CHECK(wrong.exit_code == 2);
  CHECK(count_of("--gpu", wrong.output) == 1);
  const auto checked = run_program("run --check " + scene, on(2));
  CHECK(checked.exit_code == 0);
  CHECK(count_of("stability bound:", checked.output) == 1);
}

TEST_CASE("ranks that differ in what they would compute make no step") {
  if (lacks_mpi()) return;
  const ScratchFolder folder;
  const std::string scene = test::scene_in(folder, test::verlet).string(), program = program_path();
  const std::string run = " run " + scene + " --device cpu --out " + (folder.path / "out").string();
  const auto refused = [&](const std::string& options, const std::string& options_of_second) {
    const auto told = run_program(run + options_of_second, mpirun + "-n 1 " + program + run + options + " : -n 1 ");
    CAPTURE(told.output);
    CHECK(told.exit_code == 4);
    CHECK(!std::filesystem::exists(folder.path / "out"));
    return told.output;
  };
  CHECK_THAT(refused(" --precision 32", " --precision 64"), Catch::Contains("rank 1: has other options"));
  CHECK_THAT(refused("", " --time-step 0.001"), Catch::Contains("rank 1: has other options"));
  CHECK_THAT(refused("", " --set body.right.mesh=icosphere:2"), Catch::Contains("rank 1: has other options"));
  CHECK_THAT(refused("", " --check"), Catch::Contains("rank 1: has other options"));
  std::filesystem::create_directory(folder.path / "other");
  std::ofstream(folder.path / "other/scene.toml") << read_text(scene) << "# something else\n";
  const auto told =
      run_program("run " + (folder.path / "other/scene.toml").string() + " --device cpu --out " + (folder.path / "out").string(),
                  mpirun + "-n 1 " + program + run + " : -n 1 ");
  CHECK(told.exit_code == 4);
  CHECK_THAT(told.output, Catch::Contains("rank 1: has another scene or another mesh"));
  if (cpu::available_isas().size() == 1) return;
  const auto narrow = run_program(run, mpirun + "-n 1 " + program + run + " : -n 1 env PLIANT_ISA=portable ");
  CHECK(narrow.exit_code == 4);
  CHECK_THAT(narrow.output, Catch::Contains("rank 1: has another device"));
}

}  // namespace
}  // namespace pliant
