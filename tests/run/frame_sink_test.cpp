// `pliant run --video`, with a script in ffmpeg's place.
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <memory>

#include "core/read_text.hpp"
#include "support/has.hpp"
#include "support/json.hpp"
#include "support/program.hpp"
#include "support/scratch.hpp"
#include "support/stand_in.hpp"

namespace pliant {
namespace {

using test::ReadJson;
using test::ScratchFolder;
using test::StandIn;

constexpr std::size_t picture_bytes = 3 * 64 * 48;

// A run that draws. It lasts a tenth of a second unless told otherwise, which is seven frames.
struct Drawn {
  ScratchFolder folder;
  std::string scene = (folder.path / "scene.toml").string(), video = (folder.path / "out.mp4").string();
  Drawn() {
    std::ofstream(scene) << "[simulation]\ntime_step = 0.002\nduration = 0.1\n[output]\nsize = [64, 48]\n"
                            "[[body]]\nname = \"ball\"\nmesh = \"icosphere:1\"\nvelocity = [1, 0, 0]\n";
  }
  std::filesystem::path bin() const { return folder.path / "bin"; }
  std::string input() const { return read_text(bin() / "ffmpeg.input"); }
  ProgramResult run(const std::string& options = "", const std::string& before = "") const {
    return run_program("run " + scene + " --device cpu --out " + folder.path.string() + " --video " + video + options, before);
  }
  std::vector<std::string> endless() const {
    return {"run", scene, "--device", "cpu", "--out", folder.path.string(), "--video", video, "--steps", "100000000"};
  }
  ReadJson summary() const { return ReadJson::parse(read_text(folder.path / "summary.json")); }
};

const std::string recorder = "printf '%s\\n' \"$@\" > \"$0.arguments\"\ncat > \"$0.input\"\necho whole > \"$0.end\"\n";

TEST_CASE("a video gets a picture a frame at the scene's size and rate, and no frames are written", "[gl]") {
  if (test::lacks_gl()) return;
  const Drawn drawn;
  const StandIn ffmpeg(drawn.bin(), "ffmpeg", recorder);
  const ProgramResult result = drawn.run();
  CAPTURE(result.output);
  REQUIRE(result.exit_code == 0);
  CHECK_THAT(result.output, Catch::Contains("video:   " + drawn.video + " (7 frames)"));
  CHECK(drawn.input().size() == 7 * picture_bytes);
  CHECK(drawn.input().substr(0, picture_bytes) != drawn.input().substr(6 * picture_bytes));
  const std::string arguments = read_text(drawn.bin() / "ffmpeg.arguments");
  CHECK_THAT(arguments, Catch::Contains("-video_size\n64x48\n") && Catch::Contains("-framerate\n60\n"));
  CHECK_FALSE(std::filesystem::exists(drawn.folder.path / "frames"));
}

TEST_CASE("where steps are longer than frames, a second of video is a second all the same", "[gl]") {
  if (test::lacks_gl()) return;
  const Drawn drawn;
  const StandIn ffmpeg(drawn.bin(), "ffmpeg", recorder);
  REQUIRE(drawn.run(" --set output.frame_rate=1000 --steps 10").exit_code == 0);
  CHECK(drawn.input().size() == 11 * picture_bytes);
  CHECK_THAT(read_text(drawn.bin() / "ffmpeg.arguments"), Catch::Contains("-framerate\n500\n"));
}

TEST_CASE("without ffmpeg a run says so and writes PNG frames", "[gl]") {
  if (test::lacks_gl()) return;
  const Drawn drawn;
  const ProgramResult result = drawn.run("", "PATH=" + drawn.bin().string() + " ");
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Catch::Contains("no ffmpeg on PATH") && Catch::Contains("(7 files)"));
  CHECK_THAT(drawn.summary()["warnings"].text(), Catch::Contains("no ffmpeg"));
  CHECK(std::filesystem::exists(drawn.folder.path / "frames/frame_0006.png"));
  CHECK_FALSE(std::filesystem::exists(drawn.video));
}

TEST_CASE("an ffmpeg that fails at the end costs the video alone", "[gl]") {
  if (test::lacks_gl()) return;
  const Drawn drawn;
  const StandIn ffmpeg(drawn.bin(), "ffmpeg", "cat > /dev/null\necho some line >&2\necho no room left >&2\nexit 1\n");
  const ProgramResult result = drawn.run();
  CHECK(result.exit_code == 2);
  CHECK_THAT(result.output, Catch::Contains("out.mp4: ffmpeg failed: some line | no room left"));
  CHECK(drawn.summary()["steps"] == 50);
}

TEST_CASE("a run that goes non-finite or is interrupted exits so, whatever became of its video", "[gl]") {
  if (test::lacks_gl()) return;
  const Drawn drawn;
  const StandIn ffmpeg(drawn.bin(), "ffmpeg", "cat > /dev/null\necho no room left >&2\nexit 1\n");
  const ProgramResult broken = drawn.run(
      " --integrator rk4 --set simulation.damping_law=none --time-step 1 --steps 5000 --set body.ball.stretch=[1.1,1,1]");
  CAPTURE(broken.output);
  CHECK(broken.exit_code == 5);
  CHECK_THAT(broken.output, Catch::Contains("ffmpeg failed: no room left"));
  ProgramInTerminal program(drawn.endless());
  REQUIRE(program.has_shown_progress(3));
  const ProgramResult interrupted = program.end_by(SIGINT);
  CHECK(interrupted.exit_code == 130);
  CHECK_THAT(interrupted.output, Catch::Contains("ffmpeg failed: no room left"));
}

TEST_CASE("an ffmpeg that dies on the way costs the video alone, with a warning at once", "[gl]") {
  if (test::lacks_gl()) return;
  const Drawn drawn;
  const StandIn ffmpeg(drawn.bin(), "ffmpeg", "head -c 20000 > /dev/null\necho no room left >&2\nexit 1\n");
  const ProgramResult result = drawn.run(" --steps 1000");
  CAPTURE(result.output);
  CHECK(result.exit_code == 2);
  CHECK_THAT(result.output, Catch::Contains("warning: the video ends here") && Catch::Contains("no room left"));
  CHECK_THAT(drawn.summary()["warnings"].text(), Catch::Contains("no room left"));
  CHECK(drawn.summary()["steps"] == 1000);
  CHECK(std::filesystem::exists(drawn.folder.path / "final_state.csv"));
}

TEST_CASE("Ctrl-C in the terminal ends a run with whole pictures, and lets ffmpeg end by itself", "[gl]") {
  if (test::lacks_gl()) return;
  const Drawn drawn;
  const StandIn ffmpeg(drawn.bin(), "ffmpeg", recorder);
  ProgramInTerminal program(drawn.endless());
  REQUIRE(program.has_shown_progress(3));
  const ProgramResult result = program.end_by(SIGINT);
  CAPTURE(result.output);
  CHECK(result.exit_code == 130);
  CHECK(read_text(drawn.bin() / "ffmpeg.end") == "whole\n");
  CHECK(drawn.input().size() > 0);
  CHECK(drawn.input().size() % picture_bytes == 0);
}

// The ffmpeg waits for the end of a pipe. That comes when the pipe's last writer is gone, which is the test itself.
TEST_CASE("Ctrl-C again a second later ends a run that waits for an ffmpeg without end", "[gl]") {
  if (test::lacks_gl()) return;
  const Drawn drawn;
  const StandIn ffmpeg(drawn.bin(), "ffmpeg", "cat \"$0.pipe\" > /dev/null\n");
  const std::string pipe = (drawn.bin() / "ffmpeg.pipe").string();
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> writer(std::fopen(pipe.c_str(), "r+e"), std::fclose);
  ProgramInTerminal program(drawn.endless());
  REQUIRE(program.has_shown_progress(3));
  CHECK(program.end_by_repeated(SIGINT).exit_code == 130);
}

TEST_CASE("a video goes with no other frames and with no checkpoint") {
  for (const std::string options : {"scene.toml --frames png", "scene.toml --checkpoint x", "--resume x"}) {
    const ProgramResult result = run_program("run --video out.mp4 " + options);
    CHECK(result.exit_code == 2);
    CHECK_THAT(result.output, Catch::Contains("--video"));
  }
}

}  // namespace
}  // namespace pliant
