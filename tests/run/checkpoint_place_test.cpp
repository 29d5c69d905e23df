// Where checkpoints may stand, what is never replaced by one, and one that can't be written.
#include <sys/stat.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>

#include "core/read_text.hpp"
#include "output/file_lock.hpp"
#include "support/checkpointed_runs.hpp"
#include "support/program.hpp"
#include "support/scratch.hpp"

namespace pliant {
namespace {

using test::Begun;
using test::scene_in;
using test::ScratchFolder;
using test::verlet;

TEST_CASE("a checkpoint in the place of one of the run's outputs exits with 2, by whatever name, and changes no file") {
  const ScratchFolder folder;
  const std::string scene = scene_in(folder, verlet).string(), out = (folder.path / "out").string();
  const std::string frames = " --frames obj";
  for (const auto& [name, more] : {std::pair<std::string, std::string>{"history.csv", ""},
                                   {"final_state.csv", ""},
                                   {"./summary.json", ""},
                                   {"frames/frame_0001.obj", frames},
                                   {"./frames/anything", frames}}) {
    const ProgramResult result = run_program("run " + scene + " --device cpu --quiet --duration 0.1 --out " + out +
                                             " --checkpoint " + out + "/" + name + more);
    CAPTURE(name, result.output);
    CHECK(result.exit_code == 2);
    CHECK_THAT(result.output, Catch::Contains("is where the run writes"));
    CHECK_FALSE(std::filesystem::exists(out));
  }
  for (const std::string& name : {std::string("./out/summary.json"), out + ".lock", out + "/./final_state.csv"}) {
    const ProgramResult relative =
        run_program("run " + scene + " --device cpu --quiet --duration 0.1 --out out --checkpoint " + name,
                    "cd " + folder.path.string() + " && ");
    CAPTURE(name, relative.output);
    CHECK(relative.exit_code == 2);
    CHECK_THAT(relative.output, Catch::Contains("is where the run writes"));
  }
  std::filesystem::create_symlink("out/history.csv", folder.path / "link");
  const ProgramResult result = run_program("run " + scene + " --device cpu --quiet --duration 0.1 --out " + out +
                                           " --checkpoint " + (folder.path / "link").string());
  CHECK(result.exit_code == 2);
  CHECK_FALSE(std::filesystem::exists(out));
}

TEST_CASE("what stands where a checkpoint's lock would be exits with 2, and is left as it is") {
  const ScratchFolder folder;
  const auto checkpoint = folder.path / "c", lock = folder.path / "c.lock", out = folder.path / "out";
  std::filesystem::rename(scene_in(folder, verlet), lock);
  const std::string before = read_text(lock);
  const ProgramResult result = run_program("run " + lock.string() + " --device cpu --quiet --duration 0.1 --out " + out.string() +
                                           " --checkpoint " + checkpoint.string());
  CAPTURE(result.output);
  CHECK(result.exit_code == 2);
  CHECK_THAT(result.output, Catch::Contains("c.lock: is not a lock file of pliant"));
  CHECK(read_text(lock) == before);
  CHECK_FALSE(std::filesystem::exists(checkpoint));
  CHECK_FALSE(std::filesystem::exists(out));
}

// If the run waited for a reader, `timeout` would end it with 124.
TEST_CASE("a pipe is no place for a checkpoint: that exits with 2, and at once") {
  const ScratchFolder folder;
  const auto pipe = folder.path / "pipe", out = folder.path / "out";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const ProgramResult result =
      run_program("run " + scene_in(folder, verlet).string() + " --device cpu --quiet --duration 0.1 --out " + out.string() +
                      " --checkpoint " + pipe.string(),
                  "timeout -k 1 60 ");
  CAPTURE(result.output);
  CHECK(result.exit_code == 2);
  CHECK_THAT(result.output, Catch::Contains("pipe: is no plain file"));
  CHECK(std::filesystem::is_fifo(pipe));
  CHECK_FALSE(std::filesystem::exists(out));
}

TEST_CASE("two runs do not write one checkpoint: the second exits with 2 and changes no file") {
  const ScratchFolder folder;
  const std::string scene = scene_in(folder, verlet).string(), checkpoint = (folder.path / "run.checkpoint").string();
  const std::string first = (folder.path / "first").string(), second = (folder.path / "second").string();
  ProgramInTerminal program({"run", scene, "--device", "cpu", "--out", first, "--checkpoint", checkpoint});
  REQUIRE(program.has_shown_progress(1));
  const std::string before = read_text(checkpoint);
  for (const std::string& begins :
       {scene + " --device cpu --checkpoint " + checkpoint + " --out " + second, "--resume " + checkpoint}) {
    const ProgramResult result = run_program("run --quiet " + begins);
    CAPTURE(begins, result.output);
    CHECK(result.exit_code == 2);
    CHECK_THAT(result.output, Catch::Contains("is in use by another run"));
  }
  CHECK_FALSE(std::filesystem::exists(second));
  CHECK(read_text(checkpoint) == before);
  program.end_by(SIGKILL);
  CHECK(run_program("run --quiet --resume " + checkpoint).exit_code == 0);
  CHECK_FALSE(std::filesystem::exists(checkpoint + ".lock"));
}

// The error that comes first tells the order, because what is there cannot be read as a checkpoint.
TEST_CASE("a run that is resumed has its checkpoint for itself from before it is read on, wherever it goes on writing") {
  const ScratchFolder folder;
  const auto checkpoint = folder.path / "run.checkpoint";
  std::ofstream(checkpoint) << "no checkpoint yet";
  const std::string resumed = "run --quiet --resume " + checkpoint.string();
  for (const std::string& elsewhere : {std::string(), " --checkpoint " + (folder.path / "other").string()}) {
    CHECK(run_program(resumed + elsewhere).exit_code == 3);
    const FileLock other_run(checkpoint);
    const ProgramResult result = run_program(resumed + elsewhere);
    CHECK(result.exit_code == 2);
    CHECK_THAT(result.output, Catch::Contains("is in use by another run"));
  }
  CHECK(run_program("run --resume " + (folder.path / "no/such").string()).exit_code == 3);
  CHECK_FALSE(std::filesystem::exists(folder.path / "no"));
}

// A limit on the size of files stands in for a full disk.
TEST_CASE("a checkpoint that can't be written costs no run, and is told of once") {
  const ScratchFolder folder;
  const auto checkpoint = folder.path / "c";
  const ProgramResult result = run_program("run " + scene_in(folder, verlet).string() +
                                               " --device cpu --duration 0.1 --quiet --checkpoint-every 0 --checkpoint " +
                                               checkpoint.string() + " --out " + folder.path.string(),
                                           "trap '' XFSZ; ulimit -f 24; ");
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Catch::StartsWith("pliant: warning: no checkpoint is written: ") &&
                                Catch::Contains("the run goes on, and has no checkpoint yet\n"));
  CHECK(std::ranges::count(result.output, '\n') == 1);
  CHECK_FALSE(std::filesystem::exists(checkpoint));
  CHECK(std::filesystem::exists(folder.path / "summary.json"));
}

TEST_CASE("where a checkpoint can't be replaced by the next one a warning says that it stays") {
  const Begun begun;
  begun.lengthen();
  const std::string before = read_text(begun.checkpoint);
  const ProgramResult result = run_program("run --quiet --resume " + begun.checkpoint, "trap '' XFSZ; ulimit -f 24; ");
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Catch::Contains("the run goes on, and the checkpoint before it stays"));
  CHECK(read_text(begun.checkpoint) == before);
}

}  // namespace
}  // namespace pliant
