// What a run leaves in its folder.
#include <sys/stat.h>

#include <array>
#include <catch2/catch.hpp>
#include <csignal>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>

#include "core/read_text.hpp"
#include "output/file_lock.hpp"
#include "output/video.hpp"
#include "support/has.hpp"
#include "support/program.hpp"
#include "support/runs.hpp"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#include <stb/stb_image.h>

namespace pliant {
namespace {

using test::line_count;
using test::ScratchFolder;
using test::small_scene;
using test::summary_in;

TEST_CASE("a run writes its summary, history and final state") {
  const ScratchFolder folder;
  const auto out = folder.path / "out";
  const ProgramResult result = run_program("run " + small_scene(folder).string() + " --device cpu --out " + out.string());
  CAPTURE(result.output);
  REQUIRE(result.exit_code == 0);
  const auto summary = summary_in(out);
  for (const char* key : {"scene", "device", "precision", "threads", "integrator", "time_step", "steps", "simulated_seconds",
                          "wall_seconds", "steps_per_second", "energy", "contacts", "final_intersecting_pairs", "non_finite",
                          "warnings", "work", "skipped", "timings_ms", "version"})
    CHECK(summary.contains(key));
  CHECK(summary["steps"] == 20);
  CHECK(summary["integrator"] == "dop853");
  CHECK(summary["contacts"]["steps"] > 0);
  CHECK(summary["energy"]["max_drift"].is_null());
  CHECK(line_count(read_text(out / "final_state.csv")) == 1 + 84);
  CHECK(line_count(read_text(out / "history.csv")) == 1 + 1 + 12);  // t = 0, and frames at 60 per second until 0.2 s
  CHECK(result.output.find((out / "summary.json").string()) != std::string::npos);
}

TEST_CASE("a run tells how many impulses there were at once, or triangle pairs that touched") {
  const ScratchFolder folder;
  for (const auto& [response, counted] : {std::pair("impulse", "impulses"), std::pair("reflect", "triangle pairs")}) {
    const ProgramResult result =
        run_program("run " + small_scene(folder).string() + " --device cpu --set collision.response=" + response + " --out " +
                    folder.path.string());
    CAPTURE(result.output);
    REQUIRE(result.exit_code == 0);
    const auto contacts = summary_in(folder.path)["contacts"];
    CHECK(contacts["pairs_max"] > 0);
    CHECK_THAT(result.output, Catch::Contains("contacts in " + contacts["steps"].text() + " steps, at most " +
                                              contacts["pairs_max"].text() + " " + counted + " at once"));
  }
}

TEST_CASE("a step longer than a frame gives one frame and one row of history, however much longer") {
  const ScratchFolder folder;
  for (const std::string time_step : {"0.01", "1e10"}) {
    CAPTURE(time_step);
    const auto out = folder.path / time_step;
    const ProgramResult result =
        run_program("run " + small_scene(folder).string() + " --device cpu --steps 3 --frames obj --set output.frame_rate=250" +
                    " --set collision.response=none --integrator verlet --set simulation.damping_law=none --time-step " +
                    time_step + " --out " + out.string());
    CAPTURE(result.output);
    CHECK(result.exit_code == 0);
    const std::filesystem::directory_iterator frames(out / "frames");
    CHECK(static_cast<std::size_t>(std::distance(begin(frames), end(frames))) == line_count(read_text(out / "history.csv")) - 1);
    CHECK(line_count(read_text(out / "history.csv")) <= 1 + 4);
    CHECK(summary_in(out)["steps"] >= 1);
  }
  for (const char* frame : {"frame_0001.obj", "frame_0002.obj", "frame_0003.obj"})
    CHECK(read_text(folder.path / "0.01/frames/frame_0000.obj") != read_text(folder.path / "0.01/frames" / frame));
}

TEST_CASE("a run of one frame says that it is one") {
  const ScratchFolder folder;
  const std::string options = " --device cpu --frames obj --out " + folder.path.string() + " --steps ";
  const std::string scene = small_scene(folder).string();
  CHECK_THAT(run_program("run " + scene + options + "0").output, Catch::Contains("frames (1 file)\n"));
  CHECK_THAT(run_program("run " + scene + options + "100").output, Catch::Contains(" files)\n"));
}

TEST_CASE("with a tolerance every frame is exactly at its time, and the summary counts steps") {
  const ScratchFolder folder;
  const ProgramResult result =
      run_program("run " + small_scene(folder).string() + " --device cpu --tolerance 1e-5 --integrator auto --frames obj --out " +
                  folder.path.string());
  CAPTURE(result.output);
  REQUIRE(result.exit_code == 0);
  std::istringstream rows(read_text(folder.path / "history.csv"));
  std::string row;
  std::getline(rows, row);
  for (int frame = 0; frame <= 12; ++frame) {
    REQUIRE(std::getline(rows, row));
    CHECK(std::strtod(row.c_str() + row.find(',') + 1, nullptr) == frame / 60.0);
  }
  const std::filesystem::directory_iterator frames(folder.path / "frames");
  CHECK(std::distance(begin(frames), end(frames)) == 13);
  const auto summary = summary_in(folder.path);
  CHECK(summary["simulated_seconds"] == 0.2);
  CHECK(summary["time_step"].is_null());
  CHECK(summary["integrator"] == "verner78_8");
  CHECK(summary["contacts"]["steps"] > 0);
  const auto adaptive = summary["adaptive"];
  CHECK(adaptive["tolerance"] == 1e-5);
  CHECK(adaptive["accepted"] == summary["steps"]);
  CHECK(adaptive["smallest_step"] > 0);
  CHECK(adaptive["largest_step"] >= adaptive["smallest_step"]);
  CHECK_THAT(result.output, Catch::Contains("rejected"));
}

TEST_CASE("zero steps write the start") {
  const ScratchFolder folder;
  const std::string common =
      "run " + small_scene(folder).string() + " --device cpu --steps 0 --quiet --out " + folder.path.string();
  REQUIRE(run_program(common).exit_code == 0);
  CHECK(summary_in(folder.path)["steps"] == 0);
  CHECK(line_count(read_text(folder.path / "history.csv")) == 2);
  std::istringstream rows(read_text(folder.path / "final_state.csv"));
  std::string row;
  double sum_x = 0, sum_vx = 0;
  std::getline(rows, row);
  CHECK(row == "body,vertex,x,y,z,vx,vy,vz");
  for (int k = 0; k < 42 && std::getline(rows, row); ++k) {
    int body = -1, vertex = -1;
    double x = 0, y = 0, z = 0, vx = 0;
    REQUIRE(std::sscanf(row.c_str(), "%d,%d,%lf,%lf,%lf,%lf", &body, &vertex, &x, &y, &z, &vx) == 6);
    CHECK(body == 0);
    CHECK(vertex == k);
    sum_x += x;
    sum_vx += vx;
  }
  CHECK(sum_x / 42 == Approx(-1.1));
  CHECK(sum_vx / 42 == Approx(4));
}

TEST_CASE("an undamped run without contact reports its energy drift") {
  const ScratchFolder folder;
  const std::string scene = small_scene(folder, "damping_law = \"none\"\n").string();
  REQUIRE(run_program("run " + scene +
                      " --device cpu --quiet --steps 10 --set body.left.stretch=[1.1,1,1] --set body.left.velocity=[0,0,0]" +
                      " --out " + folder.path.string())
              .exit_code == 0);
  const auto drift = summary_in(folder.path)["energy"]["max_drift"];
  REQUIRE(drift.is_number());
  CHECK(drift > 0);
  CHECK(drift < 1e-3);
}

// Red, green and blue of each pixel.
using Colour = std::array<unsigned char, 3>;

std::vector<Colour> pixels_of(const std::filesystem::path& path) {
  int width = 0, height = 0, channels = 0;
  unsigned char* data = stbi_load(path.c_str(), &width, &height, &channels, 3);
  REQUIRE(data != nullptr);
  std::vector<Colour> pixels(static_cast<std::size_t>(width * height));
  std::memcpy(pixels.data(), data, pixels.size() * sizeof(Colour));
  stbi_image_free(data);
  return pixels;
}

bool is_reddish(const Colour& c) { return c[0] > c[2] + 60; }
bool is_bluish(const Colour& c) { return c[2] > c[0] + 60; }

TEST_CASE("frames of the demo's scene show both bodies, and move, on either device", "[gl]") {
  if (test::lacks_gl()) return;
  const ScratchFolder folder;
  for (const std::string device : {"cpu", "gpu"}) {
    const auto out = folder.path / device;
    REQUIRE(run_program("run " + shipped_scene("two_spheres") + " --steps 20 --frames png --quiet --device " + device +
                        " --set output.size=[320,180] --out " + out.string())
                .exit_code == 0);
    const auto first = pixels_of(out / "frames/frame_0000.png"), later = pixels_of(out / "frames/frame_0001.png");
    for (const auto& picture : {first, later}) {
      CHECK(picture.size() == 320 * 180);
      CHECK(std::count_if(picture.begin(), picture.end(), is_reddish) > 1000);
      CHECK(std::count_if(picture.begin(), picture.end(), is_bluish) > 1000);
      CHECK(std::set<Colour>(picture.begin(), picture.end()).size() > 500);
    }
    CHECK(first != later);
  }
  CHECK(pixels_of(folder.path / "cpu/frames/frame_0000.png") == pixels_of(folder.path / "gpu/frames/frame_0000.png"));
}

TEST_CASE("Ctrl-C and SIGTERM end a run early and write what there is") {
  for (const int signal : {SIGINT, SIGTERM}) {
    const ScratchFolder folder;
    const std::string out = folder.path.string(), scene = small_scene(folder).string();
    ProgramInTerminal program({"run", scene, "--device", "cpu", "--steps", "100000000", "--out", out});
    REQUIRE(program.has_shown_progress(3));
    const ProgramResult result = program.end_by(signal);
    CHECK(result.exit_code == 130);
    CHECK_THAT(result.output, Catch::Contains("pliant: ends after the steps in hand, or a part of one; another Ctrl-C"));
    const auto summary = summary_in(folder.path);
    CHECK(summary["steps"] > 0);
    CHECK(summary["steps"] < 100000000);
    CHECK(summary["interrupted"] == true);
    CHECK(summary["energy"]["final"].is_number());
    CHECK(line_count(read_text(folder.path / "final_state.csv")) == 1 + 84);
  }
}

TEST_CASE("a pipe in the place of an output is an error before any step") {
  for (const std::string name : {"history.csv", "final_state.csv", "summary.json"}) {
    const ScratchFolder folder;
    REQUIRE(mkfifo((folder.path / name).c_str(), 0600) == 0);
    const ProgramResult result =
        run_program("run " + small_scene(folder).string() + " --device cpu --out " + folder.path.string());
    CHECK(result.exit_code == 2);
    CHECK_THAT(result.output, Catch::Contains(name) && Catch::Contains("is a pipe"));
    CHECK(std::filesystem::is_fifo(folder.path / name));
  }
}

TEST_CASE("two runs do not write into one folder: the second exits with 2 and changes no file") {
  const ScratchFolder folder;
  const std::string scene = small_scene(folder).string(), out = (folder.path / "out").string(),
                    video = (folder.path / "second.mp4").string();
  REQUIRE(run_program("run --quiet --device cpu --steps 2 " + scene + " --out " + out).exit_code == 0);
  ProgramInTerminal program({"run", scene, "--device", "cpu", "--steps", "100000000", "--out", out});
  REQUIRE(program.has_shown_progress(1));
  const std::string summary = read_text(folder.path / "out/summary.json"), history = read_text(folder.path / "out/history.csv");
  const ProgramResult second = run_program("run --quiet --device cpu --steps 2 " + scene + " --out " + out + " --video " + video);
  CAPTURE(second.output);
  CHECK(second.exit_code == 2);
  CHECK_THAT(second.output, Catch::Contains("/out: is in use by another run"));
  CHECK(read_text(folder.path / "out/summary.json") == summary);
  CHECK_THAT(read_text(folder.path / "out/history.csv"), Catch::StartsWith(history));
  CHECK_FALSE(std::filesystem::exists(video));
  program.end_by(SIGKILL);
  CHECK(run_program("run --quiet --device cpu --steps 2 " + scene + " --out " + out).exit_code == 0);
  CHECK_FALSE(std::filesystem::exists(out + ".lock"));
}

TEST_CASE("two runs do not write one video: the second exits with 2") {
  if (test::lacks("ffmpeg", VideoFile::has_encoder())) return;  // without it there is no video to keep
  const ScratchFolder folder;
  const std::string video = (folder.path / "film.mp4").string();
  const FileLock first(video);
  const ProgramResult second = run_program("run --quiet --device cpu --steps 2 " + small_scene(folder).string() + " --out " +
                                           (folder.path / "out").string() + " --video " + video);
  CAPTURE(second.output);
  CHECK(second.exit_code == 2);
  CHECK_THAT(second.output, Catch::Contains("film.mp4: is in use by another run"));
}

TEST_CASE("a folder has one lock, by whatever name, and a foreign file in its place is kept") {
  const ScratchFolder folder;
  const std::string scene = small_scene(folder).string(), out = (folder.path / "out").string();
  const std::string run = "run --quiet --device cpu --steps 1 " + scene + " --out ";
  REQUIRE(run_program(run + out).exit_code == 0);
  std::filesystem::create_directory_symlink("out", folder.path / "link");
  {
    const FileLock taken(out);
    for (const char* name : {"/out/", "/./out", "/link"}) CHECK(run_program(run + folder.path.string() + name).exit_code == 2);
  }
  CHECK(run_program(run + out + "/").exit_code == 0);
  std::ofstream(out + ".lock") << "mine";
  CHECK(run_program(run + out).exit_code == 2);
  CHECK(read_text(out + ".lock") == "mine");
}

TEST_CASE("frames that an earlier, longer run left are told") {
  const ScratchFolder folder;
  const std::string run = "run " + small_scene(folder).string() + " --device cpu --frames obj --out " + folder.path.string();
  CHECK_THAT(run_program(run + " --steps 6").output, Catch::Contains("frames:") && !Catch::Contains("earlier"));
  CHECK_THAT(run_program(run + " --steps 4").output, Catch::Contains("frame_0003.obj and later are of an earlier run"));
}

TEST_CASE("each format of frames has a file a frame") {
  const ScratchFolder folder;
  for (const std::string format : {"obj", "ply", "vtk"}) {
    REQUIRE(run_program("run " + small_scene(folder).string() + " --steps 4 --device cpu --quiet --frames " + format + " --out " +
                        folder.path.string())
                .exit_code == 0);
    for (const char* name : {"frame_0000.", "frame_0001.", "frame_0002."})
      CHECK(std::filesystem::file_size(folder.path / "frames" / (name + format)) > 1000);
  }
}

// A limit on the size of files stands in for a full disk.
TEST_CASE("a run that can't write says which files there are of an earlier one") {
  const ScratchFolder folder;
  const std::string run = "run " + small_scene(folder).string() + " --device cpu --steps 3 --quiet --frames obj --out " +
                          (folder.path / "out").string(),
                    full = "ulimit -f 4; ";
  const ProgramResult first = run_program(run, full);
  CHECK(first.exit_code == 2);
  CHECK_FALSE(std::filesystem::exists(folder.path / "out.lock"));
  CHECK_THAT(first.output, Catch::Contains("frame_0000.obj") && !Catch::Contains("earlier"));
  REQUIRE(run_program(run).exit_code == 0);
  const ProgramResult again = run_program(run, full);
  CHECK(again.exit_code == 2);
  CHECK_THAT(again.output, Catch::Contains("frame_0000.obj") &&
                               Catch::Contains("left there by an earlier run: final_state.csv, summary.json, frame_0000.obj and "
                                               "later frames; all else is of this one"));
}

TEST_CASE("an existing folder is written into and never emptied") {
  const ScratchFolder folder;
  std::ofstream(folder.path / "precious.txt") << "keep me";
  REQUIRE(run_program("run " + small_scene(folder).string() + " --device cpu --steps 1 --quiet --out " + folder.path.string())
              .exit_code == 0);
  CHECK(read_text(folder.path / "precious.txt") == "keep me");
}

}  // namespace
}  // namespace pliant
