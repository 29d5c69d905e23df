// The program as scripts use it: exit codes, messages and files.
#include <array>
#include <catch2/catch.hpp>
#include <csignal>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "core/read_text.hpp"
#include "gl/context.hpp"
#include "support/has.hpp"
#include "support/paths.hpp"
#include "support/program.hpp"
#include "support/scratch.hpp"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#include <stb/stb_image.h>

namespace pliant {
namespace {

using test::ScratchFolder;

std::size_t line_count(const std::string& text) { return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')); }

nlohmann::json summary_in(const std::filesystem::path& folder) {
  return nlohmann::json::parse(read_text(folder / "summary.json"));
}

// A scene of two small spheres, quick to run; `more` goes into [simulation].
std::filesystem::path small_scene(const ScratchFolder& folder, const std::string& more = "") {
  const auto path = folder.path / "small.toml";
  std::ofstream(path) << "[simulation]\ntime_step = 0.01\nduration = 0.2\n"
                      << more
                      << "[output]\nsize = [160, 90]\n"
                         "[[body]]\nname = \"left\"\nmesh = \"icosphere:1\"\nposition = [-1.1, 0, 0]\nvelocity = [4, 0, 0]\n"
                         "[[body]]\nname = \"right\"\nmesh = \"icosphere:1\"\nposition = [1.1, 0, 0]\nstiffness = 20\n";
  return path;
}

void check_fails(const std::string& arguments, int exit_code, std::initializer_list<const char*> parts) {
  CAPTURE(arguments);
  const ProgramResult result = run_program(arguments);
  CHECK(result.exit_code == exit_code);
  for (const char* part : parts) CHECK_THAT(result.output, Catch::Contains(part));
}

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

TEST_CASE("a picture too large for the driver or its memory exits with 4 before any step", "[gl]") {
  if (!test::has_gl() || !gl::list_adapters().front().is_software) return;  // a large GPU has room
  const ScratchFolder folder;
  check_fails("run " + small_scene(folder).string() +
                  " --device cpu --steps 1 --frames png --set output.size=[16384,16384] --out " + (folder.path / "out").string(),
              4, {"pliant: GPU memory", "output.size"});
  CHECK_FALSE(std::filesystem::exists(folder.path / "out" / "history.csv"));
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

TEST_CASE("a tolerance by an option replaces a scene's method that can't meet it, and says so in a line") {
  const std::string run = "run " + shipped_scene("two_spheres") + " --device cpu --check --tolerance 1e-3";
  const ProgramResult result = run_program(run);
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Catch::Contains("can't meet a tolerance: verner78_8 is taken"));
  CHECK_THAT(run_program(run + " --integrator auto").output, !Catch::Contains("is taken"));
  CHECK_THAT(run_program(run + " --integrator dop853").output, Catch::Contains("dop853") && !Catch::Contains("is taken"));
  check_fails(run + " --set simulation.integrator=cv8", 2,
              {"--set simulation.integrator=cv8", "cv8 does not estimate its error"});
}

TEST_CASE("a check with a tolerance estimates the number of steps") {
  const ScratchFolder folder;
  const ProgramResult result =
      run_program("run " + small_scene(folder).string() + " --device cpu --tolerance 1e-5 --check --out " + folder.path.string());
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Catch::Contains("by a tolerance of 1e-05") && Catch::Contains("steps:            about ") &&
                                !Catch::Contains("inf") && !Catch::Contains("nan"));
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

TEST_CASE("options replace what the scene says") {
  const ScratchFolder folder;
  const std::string run = "run " + small_scene(folder).string() + " --device cpu --quiet --out " + folder.path.string();
  REQUIRE(run_program(
              run + " --integrator rk4 --time-step 0.005 --duration 0.1 --precision 64 --threads 2 --set body.right.stiffness=80")
              .exit_code == 0);
  const auto summary = summary_in(folder.path);
  CHECK(summary["integrator"] == "rk4");
  CHECK(summary["steps"] == 20);
  CHECK(summary["time_step"] == 0.005);
  CHECK(summary["precision"] == 64);
  CHECK(summary["threads"] == 2);
}

TEST_CASE("whole numbers are decimal, whatever zeros they begin with") {
  const ScratchFolder folder;
  const std::string run = "run " + small_scene(folder).string() + " --device cpu --quiet --out " + folder.path.string();
  for (const auto& [steps, threads] : {std::pair(10, "08"), std::pair(8, "002")}) {
    const ProgramResult result = run_program(run + " --steps 0" + std::to_string(steps) + " --threads " + threads);
    CAPTURE(result.output);
    CHECK(result.exit_code == 0);
    CHECK(summary_in(folder.path)["steps"] == steps);
    CHECK(summary_in(folder.path)["threads"] == std::stoi(threads));
  }
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
  if (!test::has_gl()) return;
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
    CHECK(program.end_by(signal).exit_code == 130);
    const auto summary = summary_in(folder.path);
    CHECK(summary["steps"] > 0);
    CHECK(summary["steps"] < 100000000);
    CHECK(summary["interrupted"] == true);
    CHECK(summary["energy"]["final"].is_number());
    CHECK(line_count(read_text(folder.path / "final_state.csv")) == 1 + 84);
  }
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

TEST_CASE("an existing folder is written into and never emptied") {
  const ScratchFolder folder;
  std::ofstream(folder.path / "precious.txt") << "keep me";
  REQUIRE(run_program("run " + small_scene(folder).string() + " --device cpu --steps 1 --quiet --out " + folder.path.string())
              .exit_code == 0);
  CHECK(read_text(folder.path / "precious.txt") == "keep me");
}

TEST_CASE("a step beyond the bound runs, with a warning that says by how much") {
  const ScratchFolder folder;
  const ProgramResult result =
      run_program("run " + small_scene(folder).string() + " --device cpu --integrator verlet --time-step 0.1 --steps 1 --out " +
                  folder.path.string());
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Catch::Contains("warning") && Catch::Contains("2.05 times"));  // omega = sqrt(42 40), bound 2 / omega
}

TEST_CASE("a run that blows up but stays finite says so in its summary") {
  const ScratchFolder folder;
  const ProgramResult result =
      run_program("run " + shipped_scene("bunnies_overdamped") + " --device cpu --steps 2 --quiet --out " + folder.path.string());
  CHECK(result.exit_code == 0);
  const std::string warnings = summary_in(folder.path)["warnings"].dump();
  CHECK_THAT(warnings, Catch::Contains("1.08 times the stability bound") && Catch::Contains("the energy has grown"));
  CHECK_THAT(result.output, Catch::Contains("the energy has grown"));
}

TEST_CASE("energy that contacts have added is told from 5 % on, at an elasticity below 1 too") {
  const ScratchFolder folder;
  const auto growth_and_warnings = [&](const std::string& time_step) {
    const ProgramResult result = run_program("run " + small_scene(folder, "damping_law = \"none\"\n").string() +
                                             " --device cpu --duration 0.5 --set collision.elasticity=0.9 --quiet --time-step " +
                                             time_step + " --out " + folder.path.string());
    REQUIRE(result.exit_code == 0);
    const auto summary = summary_in(folder.path);
    return std::pair(summary["energy"]["final"].get<double>() / summary["energy"]["initial"].get<double>(),
                     summary["warnings"].dump());
  };
  const auto [grown, warnings] = growth_and_warnings("0.01");
  CHECK((grown > 1.05 && grown < 2));
  CHECK_THAT(warnings, Catch::Contains("the energy has grown 1.1") && Catch::Contains("contacts have added it"));
  const auto [shrunk, none] = growth_and_warnings("0.002");
  CHECK(shrunk < 1.05);
  CHECK_THAT(none, !Catch::Contains("energy"));
}

TEST_CASE("energy that gravity gives, wherever the world's origin is, is no growth") {
  const ScratchFolder folder;
  const ProgramResult result = run_program(
      "run " + small_scene(folder, "integrator = \"verlet\"\ndamping_law = \"none\"\ngravity = [0, -10, 0]\n").string() +
      " --device cpu --duration 2 --set body.left.position=[0,1.5,0] --set body.right.position=[0,-1.5,0]"
      " --set body.left.velocity=[0,0,0] --out " +
      folder.path.string());
  REQUIRE(result.exit_code == 0);
  CHECK_THAT(result.output, !Catch::Contains("energy"));
  CHECK(summary_in(folder.path)["energy"]["max_drift"].get<double>() < 1e-6);
}

TEST_CASE("bodies that overlap at the start are named in a warning") {
  const ScratchFolder folder;
  const ProgramResult result =
      run_program("run " + small_scene(folder).string() + " --device cpu --steps 0 --set body.right.position=[0,0,0] --out " +
                  folder.path.string());
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Catch::Contains("left, right"));
}

TEST_CASE("a run that goes non-finite says where, writes what there is and exits with 5") {
  const ScratchFolder folder;
  const ProgramResult result =
      run_program("run " + small_scene(folder, "damping_law = \"none\"\n").string() +
                  " --device cpu --integrator rk4 --time-step 1 --steps 5000 --set body.left.stretch=[1.1,1,1] --out " +
                  folder.path.string());
  CHECK(result.exit_code == 5);
  CHECK_THAT(result.output, Catch::Contains("non-finite in step") && Catch::Contains("body \"left\"") &&
                                Catch::Contains("shorten the time step"));
  CHECK(summary_in(folder.path)["non_finite"] == true);
  CHECK_THAT(summary_in(folder.path)["warnings"].dump(),
             Catch::Contains("times the stability bound") && Catch::Contains("non-finite in step"));
  CHECK(summary_in(folder.path)["energy"]["final"].is_null());
  CHECK(summary_in(folder.path)["final_intersecting_pairs"].is_null());
  CHECK_THAT(read_text(folder.path / "final_state.csv"), Catch::Contains(",nan") && !Catch::Contains("inf"));
}

TEST_CASE("a check validates and estimates without writing") {
  const ScratchFolder folder;
  const auto out = folder.path / "none";
  const ProgramResult result = run_program("run " + small_scene(folder).string() + " --device cpu --check --out " + out.string());
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Catch::Contains("stability bound") && Catch::Contains("steps:            20") &&
                                Catch::Contains("memory") && Catch::Contains("stepping time"));
  CHECK_FALSE(std::filesystem::exists(out));
}

TEST_CASE("a bad command line exits with 2") {
  const ScratchFolder folder;
  const std::string scene = small_scene(folder).string() + " --out " + folder.path.string();
  check_fails("", 2, {"pliant: ", "run, view, info, bench, mesh"});
  check_fails("fly", 2, {"pliant: there is no \"pliant fly\"", "run, view, info, bench, mesh"});
  CHECK(run_program("--fly").output == "pliant: pliant has no option --fly; `pliant --help` says more\n");
  check_fails("run", 2, {"pliant: scene", "`pliant run --help`"});
  check_fails("run " + scene + " --fly", 2, {"pliant: ", "--fly"});
  check_fails("run " + scene + " --device quantum", 2, {"--device"});
  check_fails("run " + scene + " --precision 16", 2, {"--precision"});
  check_fails("run " + scene + " --device gpu --precision 64", 2, {"precision", "CPU"});
  check_fails("run " + scene + " --device cpu --gpu 0", 2, {"--gpu"});
  check_fails("run " + scene + " --steps 3 --duration 1", 2, {"--steps"});
  check_fails("run " + scene + " --steps -1", 2, {"--steps"});
  check_fails("run " + scene + " --steps many", 2, {"--steps", "\"many\" is no whole number"});
  check_fails("run " + scene + " --steps 1e3", 2, {"--steps", "\"1e3\" is no whole number"});
  check_fails("run " + scene + " --time-step 0", 2, {"--time-step", "0 is below 1e-30"});
  check_fails("run " + scene + " --time-step nan", 2, {"--time-step", "is no number"});
  check_fails("run " + scene + " --time-step 1e300", 2, {"--time-step", "1e300 is above 1e+30"});
  check_fails("run " + small_scene(folder).string() + " --out \"\"", 2, {"--out", "empty"});
  std::ofstream(folder.path / "plain") << "text";
  for (const std::string place : {"plain", "plain/deeper"})
    check_fails("run " + small_scene(folder).string() + " --out " + (folder.path / place).string(), 2, {"plain: is no folder"});
  check_fails("run " + scene + " --set body.left.mesh=icosphere:8", 2,
              {"pliant: --set body.left.mesh=icosphere:8: body.left.mesh", "8 subdivisions are beyond 7"});
  check_fails("run " + scene + " --tolerance -1e-6", 2, {"--tolerance"});
  check_fails("run " + scene + " --tolerance nan", 2, {"--tolerance"});
  check_fails("run " + scene + " --tolerance 0.2", 2, {"--tolerance"});
  check_fails("run " + scene + " --tolerance 1e-6 --time-step 0.1", 2, {"--tolerance", "--time-step"});
  check_fails("run " + scene + " --tolerance 1e-6 --steps 10", 2, {"--tolerance", "--steps"});
  check_fails("run " + scene + " --device cpu --tolerance 1e-8", 2, {"--tolerance", "fp32", "--precision 64"});
  check_fails("run " + scene + " --device cpu --tolerance 1e-6 --integrator rk4", 2, {"--integrator", "rk4", "dop853"});
  check_fails("run " + scene + " --device cpu --integrator auto", 2, {"--integrator", "tolerance"});
  check_fails("run " + scene + " --duration -1", 2, {"--duration"});
  check_fails("run " + scene + " --duration inf", 2, {"--duration"});
  check_fails("run " + scene + " --threads 0", 2, {"--threads"});
  check_fails("run " + scene + " --frames gif", 2, {"--frames", "png"});
  check_fails("run " + scene + " --frames 2", 2, {"--frames"});
  check_fails("run " + scene + " --device cpu --integrator euler", 2, {"--integrator", "euler", "cv8"});
  check_fails("run " + scene + " --device cpu --set simulation.integrator=euler", 2,
              {"--set simulation.integrator=euler", "cv8"});
  check_fails("run " + scene + " --device cpu --integrator srkn11b", 2, {"--integrator", "damping"});
  check_fails("run " + scene + " --device cpu --duration 1e10", 2, {"--duration", "3e8 steps"});
  check_fails("run " + scene + " --device cpu --time-step 1e-20", 2, {"--time-step", "3e8 steps"});
  check_fails("run " + scene + " --device cpu --set simulation.duration=1e10", 2,
              {"--set simulation.duration=1e10", "3e8 steps"});
  check_fails("run " + scene + " --steps 300000001", 2, {"--steps", "300000001 is above 300000000"});
  check_fails("run " + scene + " --set simulation.time_stepp=1", 2, {"--set", "time_step"});
  check_fails("run " + small_scene(folder).string() + " --device cpu --steps 0 --out /dev/null/x", 2, {"another place"});
}

TEST_CASE("a place that can't be written is told before anything is read, replaced or stepped, and by a check as well") {
  const ScratchFolder folder;
  const std::string run = "run " + small_scene(folder).string() + " --device cpu --steps 3 --out ";
  const auto check_kept = [&](const std::filesystem::path& out, const char* options, const std::string& what) {
    std::ofstream(out / "history.csv") << "an earlier run's";
    for (const char* check : {"", " --check"}) check_fails(run + out.string() + options + check, 2, {what.c_str()});
    CHECK(read_text(out / "history.csv") == "an earlier run's");
  };
  for (const char* name : {"summary.json", "final_state.csv"}) {
    const auto out = folder.path / name / "out";
    std::filesystem::create_directories(out / name);
    check_kept(out, "", std::string(name) + ": can't be written");
  }
  const auto out = folder.path / "out";
  std::filesystem::create_directory(out);
  std::ofstream(out / "frames") << "no folder";
  check_kept(out, " --frames obj", "frames: is no folder");
  for (const std::string place : {"/proc/x", "/dev/null/x"})
    for (const std::string& scene : {std::string("nowhere.toml"), small_scene(folder).string()})
      for (const char* check : {"", " --check"})
        check_fails("run " + scene + " --device cpu --steps 0 --out " + place + check, 2, {"another place by --out"});
  CHECK(run_program(run + (folder.path / "new" / "deep").string() + " --check").exit_code == 0);
  CHECK_FALSE(std::filesystem::exists(folder.path / "new"));
}

TEST_CASE("a device that is not there exits with 4") {
  const ScratchFolder folder;
  check_fails("run " + small_scene(folder).string() + " --gpu 99 --out " + folder.path.string(), 4, {"; "});
}

#ifndef __SANITIZE_ADDRESS__  // whose own memory is beyond any limit
#ifndef __SANITIZE_THREAD__
TEST_CASE("more threads than the system gives exit with 4") {
  const ScratchFolder folder;
  const std::string run = "run " + small_scene(folder).string() + " --device cpu --threads 4000 --out " + folder.path.string();
  const ProgramResult result = run_program(run, "ulimit -v 4000000; ");  // [KiB]
  CHECK(result.exit_code == 4);
  CHECK_THAT(result.output, Catch::Contains("--threads: the system gave"));
}
#endif
#endif

TEST_CASE("bad input exits with 3") {
  const ScratchFolder folder;
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder.path / name, std::ios::binary) << text;
    return (folder.path / name).string();
  };
  check_fails("run nowhere.toml", 3, {"nowhere.toml"});
  check_fails("run " + write("bad.toml", "[[body]\n"), 3, {"bad.toml:1"});
  check_fails("run " + write("key.toml", "[[body]]\nmesh = \"icosphere:1\"\nstifness = 3\n"), 3, {"key.toml:3", "stiffness"});
  check_fails("run " + write("mesh.toml", "[[body]]\nmesh = \"gone.obj\"\n"), 3, {"gone.obj"});
  check_fails(
      "run --device cpu " + write("method.toml", "[simulation]\nintegrator = \"euler\"\n[[body]]\nmesh = \"icosphere:1\"\n"), 3,
      {"method.toml:2", "euler"});
  const std::string long_scene = "[simulation]\nduration = 1e10\n[[body]]\nmesh = \"icosphere:1\"\n";
  check_fails("run --device cpu --integrator rk4 " + write("long.toml", long_scene), 3, {"long.toml:2", "3e8 steps"});
  check_fails("mesh nowhere.obj", 3, {"nowhere.obj"});
  check_fails("mesh /dev/zero", 3, {"/dev/zero", "plain file"});
  check_fails("mesh icosphere:9", 3, {"icosphere"});
  check_fails("mesh " + write("empty.obj", ""), 3, {"empty.obj"});
  check_fails("mesh " + write("binary.obj", std::string("v 0 0 0\n\0\1\2", 11)), 3, {"binary.obj"});
  check_fails("mesh " + write("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"), 3, {"nan.obj:2"});
  check_fails("mesh " + write("huge.obj", "v 0 0 0\nv 1e400 0 0\nv 0 1 0\nf 1 2 3\n"), 3, {"huge.obj:2"});
  check_fails("mesh " + write("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"), 3, {"range.obj:4"});
  check_fails("mesh " + write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), 3, {"points.obj"});
}

TEST_CASE("output that cannot be written is not a success") {
  for (const char* arguments : {"info --integrators", "mesh icosphere:2 --json", "--help"})
    check_fails(std::string(arguments) + " > /dev/full", 2, {});
}

TEST_CASE("a duration too short for one step is warned of") {
  const ScratchFolder folder;
  const ProgramResult result =
      run_program("run " + small_scene(folder).string() + " --device cpu --quiet --time-step 1e6 --out " + folder.path.string());
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Catch::Contains("no step is made") && !Catch::Contains("stability bound"));
}

TEST_CASE("mesh reports counts as text and as JSON") {
  CHECK_THAT(run_program("mesh icosphere:3").output, Catch::Contains("642") && Catch::Contains("1280"));
  const ProgramResult json = run_program("mesh " + source_dir() + "/meshes/bunny.obj --json");
  REQUIRE(json.exit_code == 0);
  CHECK_THAT(json.output, Catch::Contains("3674"));
  CHECK_NOTHROW(nlohmann::json::parse(json.output));
}

TEST_CASE("info lists devices and integrators") {
  const auto devices = nlohmann::json::parse(run_program("info --json").output);
  CHECK(devices["cpu"]["threads"] >= 1);
  CHECK(devices["gpus"].size() == gl::list_adapters().size());
  const auto integrators = nlohmann::json::parse(run_program("info --integrators --json").output);
  std::vector<std::string> names, meeting_tolerances;
  for (const auto& row : integrators) {
    names.push_back(row["name"]);
    if (row["tolerance"]) meeting_tolerances.push_back(row["name"]);
  }
  CHECK(names == std::vector<std::string>{"verlet", "rk4", "srkn11b", "cv8", "cv8_minus", "dop853", "verner78_8", "vern8",
                                          "dprkn8", "dprkn12"});
  CHECK(meeting_tolerances == std::vector<std::string>{"dop853", "verner78_8", "vern8", "dprkn8", "dprkn12"});
  const std::string table = run_program("info --integrators").output;
  CHECK_THAT(table, Catch::Contains("tolerance") && Catch::Contains("\"auto\"") && Catch::Contains("squashed"));
  CHECK(run_program("--version").exit_code == 0);
  CHECK(run_program("--help").exit_code == 0);
}

}  // namespace
}  // namespace pliant
