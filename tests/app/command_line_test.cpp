// The program as scripts use it: options, exit codes and messages.
#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>

#include "core/read_text.hpp"
#include "output/video.hpp"
#include "support/has.hpp"
#include "support/json.hpp"
#include "support/paths.hpp"
#include "support/program.hpp"
#include "support/runs.hpp"

namespace pliant {
namespace {

using test::check_fails;
using test::ScratchFolder;
using test::small_scene;
using test::summary_in;

TEST_CASE("a picture too large for the driver or its memory exits with 4 before any step", "[gl]") {
  if (test::lacks_gl()) return;
  if (!gl::list_adapters().front().is_software) return test::skip("a large GPU has room for it");
  const ScratchFolder folder;
  check_fails("run " + small_scene(folder).string() +
                  " --device cpu --steps 1 --frames png --set output.size=[16384,16384] --out " + (folder.path / "out").string(),
              4, {"pliant: GPU memory", "output.size"});
  CHECK_FALSE(std::filesystem::exists(folder.path / "out" / "history.csv"));
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

TEST_CASE("an empty name of a scene or a mesh is called that") {
  check_fails("run ''", 2, {"scene: is empty; name a file"});
  check_fails("mesh ''", 2, {"mesh: is empty; name a file or a generator"});
  check_fails("view ''", 2, {"scene: is empty; name a file"});
}

TEST_CASE("folders that are missing are made for each output alike") {
  const ScratchFolder folder;
  const std::string run = "run " + small_scene(folder).string() + " --device cpu --steps 1 --quiet --out ";
  const auto place = [&](const char* name) { return folder.path / name / "below" / "it"; };
  REQUIRE(run_program(run + place("out").string() + " --checkpoint " + (place("kept") / "run.checkpoint").string()).exit_code ==
          0);
  CHECK(std::filesystem::exists(place("out") / "summary.json"));
  CHECK(std::filesystem::exists(place("kept") / "run.checkpoint"));
  if (!test::has_gl() || !test::has("ffmpeg", VideoFile::has_encoder())) return;
  const std::filesystem::path video = place("film") / "run.mp4";
  REQUIRE(run_program(run + place("out").string() + " --video " + video.string()).exit_code == 0);
  CHECK(std::filesystem::exists(video));
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

TEST_CASE("a check validates and estimates without writing") {
  const ScratchFolder folder;
  const auto out = folder.path / "none";
  const ProgramResult result = run_program("run " + small_scene(folder).string() + " --device cpu --check --out " + out.string());
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Catch::Contains("stability bound") && Catch::Contains("steps:            20") &&
                                Catch::Contains("memory") && Catch::Contains("stepping time"));
  CHECK_FALSE(std::filesystem::exists(out));
}

TEST_CASE("a check tells bodies in rows together, and those that differ apart") {
  const ScratchFolder folder;
  const auto scene = folder.path / "rows.toml";
  std::ofstream(scene) << "[[body]]\nname = \"a\"\nmesh = \"icosphere:1\"\nposition = [0, 9, 0]\n"
                          "[[body]]\nname = \"b\"\nmesh = \"icosphere:1\"\ncount = [1, 1, 50]\nspacing = [0, 0, 3]\n"
                          "\"[0,0,48]\" = { mesh = \"cube:1\" }\n"
                          "[[body]]\nname = \"c\"\nmesh = \"icosphere:1\"\nposition = [0, 18, 0]\nforces = \"clustered\"\n"
                          "[[body]]\nname = \"d\"\nmesh = \"icosphere:1\"\nposition = [0, 27, 0]\nforce_tolerance = 1e-3\n";
  const ProgramResult result = run_program("run " + scene.string() + " --device cpu --check");
  CHECK_THAT(result.output, Catch::Contains("body:             a (42 vertices, 80 triangles)\n"
                                            "bodies:           48, b[0,0,0] to b[0,0,47] (42 vertices, 80 triangles each)\n"
                                            "body:             b[0,0,48] (8 vertices, 12 triangles)\n"
                                            "body:             b[0,0,49] (42 vertices, 80 triangles)\n"
                                            "body:             c (42 vertices, 80 triangles, springs by clusters to 0.001)\n"
                                            "body:             d (42 vertices, 80 triangles, springs one by one: too few "
                                            "vertices for its force_tolerance)\n"));
}

// Steps of this scene would take longer than ctest's limit.
TEST_CASE("a check makes no step of a scene whose steps take long, with a tolerance or without") {
  const ScratchFolder folder;
  const auto scene = folder.path / "large.toml";
  std::ofstream file(scene);
  for (int k = 0; k < 3; ++k) file << "[[body]]\nmesh = \"icosphere:7\"\nposition = [" << 3 * k << ", 0, 0]\n";
  file.close();
  for (const auto& [options, count] : {std::pair("--time-step 1e-4 --steps 100", "steps:            100\n"),
                                       std::pair("--tolerance 1e-3 --duration 1", "steps:            at least 4")}) {
    const ProgramResult result = run_program("run " + scene.string() + " --device cpu --check " + options);
    CAPTURE(result.output);
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.output, Catch::Contains(count) && Catch::Contains("stepping time:    a"));
    CHECK_THAT(result.output, Catch::Contains("13422 million springs, which force_tolerance = 1e-3 would sum by clusters"));
  }
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
  check_fails("run " + scene + " --no-skipping=much", 2, {"--no-skipping", "quiet_steps"});
  check_fails("run " + scene + " --device gpu --precision 64", 2, {"precision", "CPU"});
  check_fails("run " + scene + " --device cpu --gpu 0", 2, {"--gpu"});
  check_fails("run " + scene + " --steps 3 --duration 1", 2, {"--steps"});
  check_fails("run " + scene + " --steps 3 --steps 2", 2,
              {"pliant: --steps: is given 2 times; give it once; `pliant run --help`"});
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
  check_fails("run " + scene + " --set body.left.mesh=icosphere:10", 2,
              {"pliant: --set body.left.mesh=icosphere:10: body.left.mesh", "10 subdivisions are beyond 9"});
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

// Undeformed bodies, of which one flies and one rests, far from it.
TEST_CASE("each --no-skipping=KIND adds a kind of work that a run does, and without a kind it does all") {
  const ScratchFolder folder;
  const auto skipped_with = [&](const char* options) {
    const ProgramResult result =
        run_program("run " + small_scene(folder).string() + " --device cpu --set body.right.position=[9,0,0] --out " +
                    folder.path.string() + options);
    CAPTURE(options, result.output);
    REQUIRE(result.exit_code == 0);
    const auto skipped = summary_in(folder.path)["skipped"];
    return std::pair(skipped["force_evaluations"].get<std::uint64_t>(), skipped["bodies_at_rest"].get<std::uint64_t>());
  };
  const auto [forces, rest] = skipped_with("");
  CHECK((forces > 0 && rest > 0));
  const auto with_forces = skipped_with(" --no-skipping=forces");  // which bodies at rest still leave out
  CHECK((with_forces.first < forces && with_forces.second == rest));
  CHECK((skipped_with(" --no-skipping=rest") == std::pair(forces, std::uint64_t{0})));
  for (const char* options :
       {" --no-skipping=forces --no-skipping=rest", " --no-skipping=rest --no-skipping=forces", " --no-skipping",
        " --no-skipping=quiet_steps --no-skipping", " --no-skipping --no-skipping=quiet_steps"}) {
    const auto [forces_left_out, rest_left_out] = skipped_with(options);
    CAPTURE(options);
    CHECK((forces_left_out == 0 && rest_left_out == 0));
  }
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

#ifndef __SANITIZE_ADDRESS__  // its own memory is beyond any limit
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
  check_fails("mesh icosphere:10", 3, {"icosphere"});
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

TEST_CASE("mesh reports counts as text and as JSON") {
  CHECK_THAT(run_program("mesh icosphere:3").output, Catch::Contains("642") && Catch::Contains("1280"));
  const ProgramResult json = run_program("mesh " + source_dir() + "/meshes/bunny.obj --json");
  REQUIRE(json.exit_code == 0);
  CHECK_THAT(json.output, Catch::Contains("3674"));
  CHECK_NOTHROW(test::ReadJson::parse(json.output));
}

}  // namespace
}  // namespace pliant
