// Runs with checkpoints, and what tests look at in them.
#pragma once
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/read_text.hpp"
#include "output/checkpoint_file.hpp"
#include "support/json.hpp"
#include "support/program.hpp"
#include "support/scratch.hpp"

namespace pliant::test {

// Two small spheres that collide. The run has so many reports that it waits for someone to read its progress before it is over.
inline std::filesystem::path scene_in(const ScratchFolder& folder, const std::string& simulation,
                                      const std::string& mesh = "icosphere:1") {
  const auto path = folder.path / "scene.toml";
  std::ofstream(path) << "[simulation]\n"
                      << simulation << "\n[output]\nframe_rate = 100\n"
                      << "[[body]]\nname = \"left\"\nmesh = \"" << mesh << "\"\nposition = [-1.1, 0, 0]\nvelocity = [4, 0, 0]\n"
                      << "[[body]]\nname = \"right\"\nmesh = \"icosphere:1\"\nposition = [1.1, 0, 0]\nstiffness = 20\n";
  return path;
}

inline const std::string verlet = "time_step = 0.002\nintegrator = \"verlet\"\nduration = 4";

// What a run says of itself, without how long it took.
inline ReadJson account_in(const std::filesystem::path& folder) {
  auto summary = ReadJson::parse(read_text(folder / "summary.json"));
  for (const char* key : {"wall_seconds", "steps_per_second", "timings_ms"}) summary = summary.without(key);
  return summary;
}

// A short run, and its checkpoint from the end.
struct Begun {
  ScratchFolder folder;
  std::string checkpoint = (folder.path / "run.checkpoint").string();
  explicit Begun(const std::string& mesh = "icosphere:1", const std::string& options = "") {
    const std::string scene = scene_in(folder, "time_step = 0.002\nintegrator = \"verlet\"\nduration = 0.2", mesh).string();
    const ProgramResult result = run_program("run " + scene + " --device cpu --quiet --checkpoint-every 0" + " --checkpoint " +
                                             checkpoint + " --out " + (folder.path / "out").string() + options);
    CAPTURE(result.output);
    REQUIRE(result.exit_code == 0);
  }
  ProgramResult resume(const std::string& options = "") const {
    return run_program("run --quiet --resume " + checkpoint + options);
  }
  void check_refused(int exit_code, const std::string& what, const std::string& options = "") const {
    const std::string before = read_text(checkpoint), history = read_text(folder.path / "out/history.csv");
    const ProgramResult result = resume(options);
    CAPTURE(result.output);
    CHECK(result.exit_code == exit_code);
    CHECK_THAT(result.output, Catch::Contains("run.checkpoint") && Catch::Contains(what));
    CHECK(read_text(checkpoint) == before);
    CHECK(read_text(folder.path / "out/history.csv") == history);
  }
  // Replaces `before` by `now` in the checkpoint, as if it had been written so.
  void replace(const std::string& before, const std::string& now) const {
    REQUIRE(before.size() == now.size());
    std::string content = read_checkpoint(checkpoint);
    const auto at = content.find(before);
    REQUIRE(at != std::string::npos);
    write_checkpoint(checkpoint, content.replace(at, now.size(), now));
  }
  // Makes the run last longer, so that steps are left.
  void lengthen() const { replace("duration = 0.2", "duration = 0.3"); }
};

}  // namespace pliant::test
