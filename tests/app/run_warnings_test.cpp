// What a run says of its motion: warnings, and where it breaks down.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "core/read_text.hpp"
#include "support/program.hpp"
#include "support/runs.hpp"

namespace pliant {
namespace {

using test::ScratchFolder;
using test::small_scene;
using test::summary_in;

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
  const std::string warnings = summary_in(folder.path)["warnings"].text();
  CHECK_THAT(warnings, Catch::Contains("1.08 times the stability bound") && Catch::Contains("the energy has grown"));
  CHECK_THAT(result.output, Catch::Contains("the energy has grown"));
}

// The sphere is a tenth as large as at rest, and passes through itself.
TEST_CASE("a run tells of errors of a clustered body, of energy that new lists brought, and of a body that gave clusters up") {
  const ScratchFolder folder;
  std::ofstream(folder.path / "ball.toml") << R"([simulation]
integrator = "verlet"
duration = 1

[[body]]
name = "ball"
mesh = "icosphere:4"
total_mass = 1
total_stiffness = 1000
damping = 0
forces = "clustered"
stretch = [0.1, 0.1, 0.1]
)";
  const auto told_by = [&](const char* time_step) {
    const std::string out = (folder.path / "out").string();
    const ProgramResult result =
        run_program("run " + (folder.path / "ball.toml").string() + " --device cpu --time-step " + time_step + " --out " + out);
    CHECK(result.exit_code == 0);
    return result.output;
  };
  CHECK_THAT(told_by("0.01"), Catch::Contains("forces of \"ball\" were off by") &&
                                  Catch::Contains("lists of clusters that were made anew have changed it"));
  CHECK_THAT(told_by("0.04"), Catch::Contains("went over to sums of all its springs"));
  CHECK_THAT(told_by("0.04 --steps 0"), Catch::Contains("were never checked"));
  CHECK(summary_in(folder.path / "out")["clusters"]["largest_error"].is_null());
}

struct Energies {
  double first = 0, largest = 0, latest = 0;  // in rows of the history [J]
  double time_of_largest = 0;                 // [s]
};

Energies energies_in(const ScratchFolder& folder) {
  Energies found;
  std::istringstream rows(read_text(folder.path / "history.csv"));
  std::string row;
  for (std::getline(rows, row); std::getline(rows, row);) {
    double time = 0;
    REQUIRE(std::sscanf(row.c_str(), "%*[^,],%lf,%*[^,],%*[^,],%*[^,],%lf", &time, &found.latest) == 2);
    if (time == 0) found.first = found.latest;
    if (found.latest <= found.largest) continue;
    found.largest = found.latest;
    found.time_of_largest = time;
  }
  return found;
}

TEST_CASE("a run tells how late a scripted body is, what it gave, and which path its steps miss") {
  const ScratchFolder folder;
  const auto file = folder.path / "press.toml";
  std::ofstream(file)
      << "[simulation]\nintegrator = \"cv8\"\ntime_step = 0.01\nduration = 0.8\ngravity = [0, -9.81, 0]\n[[ground]]\n"
         "[[body]]\nmesh = \"icosphere:1\"\nposition = [0, 1.05, 0]\ntotal_mass = 1\ntotal_stiffness = 2000\n"
         "[[body]]\nname = \"press\"\nkind = \"scripted\"\nmesh = \"box:2,0.2,2,4\"\n"
         "path = [{ time = 0, position = [0, 2.3, 0] }, { time = 0.5, position = [0, -0.2, 0] }]\n"
         "[[body]]\nname = \"shaker\"\nkind = \"scripted\"\nmesh = \"cube:1\"\nrepeats = true\nposition = [9, 5, 0]\n"
         "path = [{ time = 0 }, { time = 0.01, position = [0, 1, 0] }, { time = 0.02, position = [0, 0, 0] }]\n";
  const ProgramResult result = run_program("run " + file.string() + " --device cpu --out " + folder.path.string());
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Catch::Contains("miss part of the path of \"shaker\"") && Catch::Contains("at most 0.005"));
  CHECK_THAT(result.output, Catch::Contains("body \"press\" waited") && Catch::Contains("scripted bodies gave"));
  CHECK_THAT(result.output, !Catch::Contains("the energy has grown"));
  const auto press = summary_in(folder.path)["scripts"]["press"];
  CHECK(press["waits"] > 0);
  CHECK(press["time"].get<double>() + press["waited"].get<double>() == Approx(0.8));
  CHECK(summary_in(folder.path)["final_intersecting_pairs"] == 0);
}

TEST_CASE("energy that contacts have added is told from 5 % on, at an elasticity below 1 too") {
  const ScratchFolder folder;
  const auto growth_and_warnings = [&](const std::string& time_step) {
    const ProgramResult result =
        run_program("run " + small_scene(folder, "damping_law = \"none\"\n").string() +
                    " --device cpu --duration 0.5 --set collision.response=reflect --quiet --time-step " + time_step + " --out " +
                    folder.path.string());
    REQUIRE(result.exit_code == 0);
    const Energies energies = energies_in(folder);
    return std::pair(energies.largest / energies.first, summary_in(folder.path)["warnings"].text());
  };
  const auto [grown, warnings] = growth_and_warnings("0.01");
  CHECK((grown > 1.05 && grown < 2));
  CHECK_THAT(warnings, Catch::Contains("the energy has grown") && Catch::Contains("contacts have added it") &&
                           Catch::Contains("; try a shorter time step"));
  const double told = std::stod(warnings.substr(warnings.find("the energy has grown ") + 21));
  CHECK(told == Approx(grown).epsilon(0.01));
  const auto [shrunk, none] = growth_and_warnings("0.002");
  CHECK(shrunk < 1.05);
  CHECK_THAT(none, !Catch::Contains("energy"));
}

TEST_CASE("energy that grew on the way and was damped away again is told, with its time") {
  const ScratchFolder folder;
  const ProgramResult result =
      run_program("run " + small_scene(folder, "damping_law = \"constant\"\n").string() +
                  " --device cpu --duration 3 --set collision.response=reflect --set body.left.damping=0.3"
                  " --set body.right.damping=0.3 --quiet --out " +
                  folder.path.string());
  REQUIRE(result.exit_code == 0);
  const Energies energies = energies_in(folder);
  REQUIRE(energies.largest > 1.05 * energies.first);
  REQUIRE(energies.latest < energies.first);
  CHECK_THAT(summary_in(folder.path)["warnings"].text(),
             Catch::Contains(fmt::format("the energy has grown {:.3g}-fold at {:.6g} s: contacts",
                                         energies.largest / energies.first, energies.time_of_largest)));
}

TEST_CASE("energy that a scene at rest gets from contacts is told in joules, and does not end the run") {
  const ScratchFolder folder;
  const auto scene = folder.path / "near.toml";
  std::ofstream(scene) << "[simulation]\nintegrator = \"verlet\"\ndamping_law = \"none\"\n[[body]]\nmesh = \"icosphere:1\"\n"
                          "[[body]]\nmesh = \"icosphere:1\"\nposition = [2.0001, 0, 0]\n";
  const ProgramResult result =
      run_program("run " + scene.string() + " --device cpu --precision 64 --steps 200 --quiet --out " + folder.path.string());
  CHECK(result.exit_code == 0);
  CHECK_THAT(
      result.output,
      Catch::Contains("nearer than the gap") &&
          Catch::Matches("(?:.|\n)*the energy has grown by [0-9.e-]+ J at [0-9.e-]+ s, and was too small at the start(?:.|\n)*"));
}

// Runs a body with pressure, at rest at the start.
ProgramResult run_balloon(const ScratchFolder& folder, const std::string& more) {
  const auto path = folder.path / "balloon.toml";
  std::ofstream(path) << "[simulation]\nintegrator = \"verlet\"\ndamping_law = \"none\"\n[[body]]\nname = \"balloon\"\n"
                         "mesh = \"icosphere:1\"\nstiffness = 1\npressure = 5\n";
  return run_program("run " + path.string() + " --device cpu --quiet " + more + " --out " + folder.path.string());
}

std::string warnings_of_balloon(const std::string& more) {
  const ScratchFolder folder;
  REQUIRE(run_balloon(folder, more).exit_code == 0);
  return summary_in(folder.path)["warnings"].text();
}

TEST_CASE("a body with pressure that comes to no volume ends the run, and its volume is named") {
  const ScratchFolder folder;
  const ProgramResult late = run_balloon(folder, "--time-step 0.36 --steps 8");
  CHECK(late.exit_code == 5);
  CHECK_THAT(late.output, Catch::Contains("non-finite") &&
                              Catch::Contains("body \"balloon\", whose volume may have come to zero or grown without end"));
  const ProgramResult early = run_balloon(folder, "--time-step 0.01 --steps 8 --set body.balloon.stretch=[-1,1,1]");
  CHECK(early.exit_code == 3);
  CHECK_THAT(early.output, Catch::Contains("balloon.toml:4") && Catch::Contains("-1 of its rest volume"));
}

TEST_CASE("a body that pressure sets in motion has not grown in energy, unless its motion is unstable") {
  for (const char* method : {"verlet", "cv8", "dop853"})
    for (const char* law : {"gas", "constant"})
      for (const char* steps : {"1", "40", "400"}) {
        CAPTURE(method, law, steps);
        CHECK_THAT(warnings_of_balloon(std::string("--time-step 0.01 --integrator ") + method + " --steps " + steps +
                                       " --set body.balloon.pressure_law=" + law),
                   !Catch::Contains("energy"));
      }
  const std::string warnings = warnings_of_balloon("--time-step 0.36 --steps 8 --set body.balloon.pressure=1e-6");
  CHECK_THAT(warnings,
             Catch::Contains("1.17 times the stability bound") && Catch::Contains("the energy has grown by 1 times the most"));
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
  const ProgramResult result = run_program(
      "run " + small_scene(folder).string() +
      " --device cpu --steps 0 --set body.right.position=[0,0,0] --set collision.response=reflect --out " + folder.path.string());
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Catch::Contains("left, right"));
}

TEST_CASE("bodies that overlap can't begin with contact by impulses") {
  const ScratchFolder folder;
  const ProgramResult result =
      run_program("run " + small_scene(folder).string() + " --device cpu --set body.right.position=[0,0,0] --out " +
                  folder.path.string() + "/out");
  CHECK(result.exit_code == 3);
  CHECK_THAT(result.output, Catch::Contains("\"left\" and \"right\" intersect, at least") && Catch::Contains("move them apart") &&
                                Catch::Contains("or write response"));
  CHECK_FALSE(std::filesystem::exists(folder.path / "out"));
}

TEST_CASE("masses and edges that contact by impulses can't resolve are named in warnings, with that response alone") {
  const auto warnings = [](const std::string& options) {
    const ScratchFolder folder;
    const ProgramResult result = run_program("run " + small_scene(folder).string() + " --device cpu --steps 0 --quiet " +
                                             options + " --out " + folder.path.string());
    CHECK(result.exit_code == 0);
    return summary_in(folder.path)["warnings"].text();
  };
  const std::string masses = "--set body.left.vertex_mass=2e9",
                    edges = "--set body.left.scale=1e-4 --set body.right.scale=100 --set body.right.position=[200,0,0]",
                    reflect = " --set collision.response=reflect";
  CHECK_THAT(warnings(masses), Catch::Contains("\\\"left\\\" has 2e+09 times the mass of one of \\\"right\\\""));
  CHECK(warnings("--set body.left.vertex_mass=5e8") == "[]");
  CHECK_THAT(warnings(edges), Catch::Contains("contacts of body \\\"left\\\" with \\\"right\\\" are lost in rounding") &&
                                  Catch::Contains("--precision 64"));
  CHECK(warnings(edges + " --precision 64") == "[]");
  for (const std::string& options : {masses, edges}) CHECK(warnings(options + reflect) == "[]");
}

TEST_CASE("steps of fast bodies fall into parts, and no time is lost") {
  const ScratchFolder folder;
  const ProgramResult result = run_program(
      "run " + small_scene(folder, "damping_law = \"none\"\n").string() +
      " --device cpu --duration 0.5 --time-step 0.01 --set body.left.velocity=[400,0,0] --out " + folder.path.string());
  CHECK(result.exit_code == 0);
  const auto summary = summary_in(folder.path);
  CHECK(summary["contacts"]["substeps"] > 8);
  CHECK(summary["steps"] == 50);
  CHECK(summary["simulated_seconds"].get<double>() == Approx(0.5));
  CHECK(summary["final_intersecting_pairs"] == 0);
}

TEST_CASE("a body that meets a ground too fast is told, with a remedy, and one turned back by reflection is not") {
  const ScratchFolder folder;
  const auto path = folder.path / "fast.toml";
  std::ofstream(path) << "[simulation]\ntime_step = 0.001\n[[ground]]\n[[body]]\nmesh = \"icosphere:2\"\nposition = [0, 3, 0]\n"
                         "velocity = [0, -1e6, 0]\n";
  const ProgramResult result =
      run_program("run " + path.string() + " --device cpu --steps 5 --quiet --out " + folder.path.string());
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Catch::Contains("cut short 162 times") &&
                                Catch::Contains("try a larger gap, stiffer bodies or a shorter time step"));
  CHECK_THAT(summary_in(folder.path)["warnings"].text(), Catch::Contains("cut short 162 times"));
  const ProgramResult turned =
      run_program("run " + small_scene(folder).string() +
                  " --device cpu --duration 1 --quiet --set collision.elasticity=0 --set collision.response=reflect --out " +
                  folder.path.string());
  CHECK(turned.exit_code == 0);
  CHECK(summary_in(folder.path)["contacts"]["reverted_vertices"] > 100);
  CHECK_THAT(turned.output, !Catch::Contains("cut short"));
}

TEST_CASE("of many bodies that overlap some are named, and the rest counted") {
  const ScratchFolder folder;
  const auto scene = folder.path / "many.toml";
  std::ofstream file(scene);
  file << "[collision]\nresponse = \"reflect\"\n";
  for (int k = 0; k < 12; ++k) file << "[[body]]\nmesh = \"icosphere:0\"\n";
  file.close();
  const ProgramResult result =
      run_program("run " + scene.string() + " --device cpu --steps 0 --out " + folder.path.string() + "/out");
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Catch::Contains("body7 and 4 more") && !Catch::Contains("body8"));
}

TEST_CASE("a run that goes non-finite says where, writes what there is and exits with 5") {
  const ScratchFolder folder;
  const ProgramResult result = run_program("run " + small_scene(folder, "damping_law = \"none\"\n").string() +
                                           " --device cpu --integrator rk4 --time-step 1 --steps 5000 --set "
                                           "collision.response=reflect --set body.left.stretch=[1.1,1,1] --out " +
                                           folder.path.string());
  CHECK(result.exit_code == 5);
  CHECK_THAT(result.output, Catch::Contains("non-finite in step") && Catch::Contains("body \"left\"") &&
                                Catch::Contains("shorten the time step"));
  CHECK(summary_in(folder.path)["non_finite"] == true);
  CHECK_THAT(summary_in(folder.path)["warnings"].text(),
             Catch::Contains("times the stability bound") && Catch::Contains("non-finite in step"));
  CHECK(summary_in(folder.path)["energy"]["final"].is_null());
  CHECK(summary_in(folder.path)["final_intersecting_pairs"].is_null());
  CHECK_THAT(read_text(folder.path / "final_state.csv"), Catch::Contains(",nan") && !Catch::Contains("inf"));
}

TEST_CASE("a run that can't meet its tolerance is not called non-finite, and its final energy is told") {
  const ScratchFolder folder;
  const auto scene = folder.path / "hopeless.toml";
  std::ofstream(scene) << "[simulation]\ntolerance = 1e-14\nduration = 1e6\ndamping_law = \"none\"\n"
                          "[output]\nframe_rate = 1e-6\n[[body]]\nmesh = \"icosphere:1\"\nstretch = [1.1, 1, 1]\n";
  const ProgramResult result =
      run_program("run " + scene.string() + " --device cpu --precision 64 --quiet --out " + folder.path.string());
  CHECK(result.exit_code == 5);
  CHECK_THAT(result.output, Catch::Contains("the tolerance of 1e-14"));
  const auto summary = summary_in(folder.path);
  CHECK(summary["non_finite"] == false);
  CHECK(summary["energy"]["final"].get<double>() == Approx(summary["energy"]["initial"].get<double>()));
  CHECK_THAT(summary["warnings"].text(), Catch::Contains("the tolerance of 1e-14"));
}

TEST_CASE("a run whose energy grows a thousandfold while its steps fall into parts says so and exits with 5") {
  // 1.74 times the bound: the energy takes some 130 steps to grow so far, so that no number overflows first.
  const ScratchFolder folder;
  const ProgramResult result =
      run_program("run " + small_scene(folder, "damping_law = \"none\"\n").string() +
                  " --device cpu --integrator rk4 --time-step 0.12 --steps 5000 --set body.left.stretch=[1.1,1,1] --out " +
                  folder.path.string());
  CHECK(result.exit_code == 5);
  CHECK_THAT(result.output, Catch::Contains("the energy has grown") && Catch::Contains("which ends the run") &&
                                Catch::Contains("try a shorter time step"));
  const auto summary = summary_in(folder.path);
  CHECK(summary["non_finite"] == false);
  CHECK(summary["steps"].get<double>() < 1000);
  CHECK(summary["contacts"]["substeps"].get<double>() > 0);
  CHECK(summary["energy"]["final"].get<double>() >= 1000 * summary["energy"]["initial"].get<double>());
}

TEST_CASE("energy of a push at the start is no blow-up once a scripted body gives a little") {
  const ScratchFolder folder;
  const auto scene = folder.path / "touched.toml";
  std::ofstream(scene) << "[simulation]\nintegrator = \"verlet\"\n";
  for (const char* position : {"[0, 0, 0]", "[1.0001, 0, 0]"})
    std::ofstream(scene, std::ios::app) << "[[body]]\nmesh = \"cube:3\"\ntotal_mass = 1\ntotal_stiffness = 1000\nposition = "
                                        << position << "\n";
  std::ofstream(scene, std::ios::app) << "[[body]]\nkind = \"scripted\"\nmesh = \"icosphere:1\"\nscale = 0.1\n"
                                         "position = [-0.65, 0, 0]\nvelocity = [0.0001, 0, 0]\n";
  const ProgramResult result =
      run_program("run " + scene.string() + " --device cpu --duration 2.5 --quiet --out " + folder.path.string());
  CHECK(result.exit_code == 0);
  const auto summary = summary_in(folder.path);
  CHECK(summary["contacts"]["work_of_scripts"].get<double>() > 0);
  CHECK_THAT(result.output, Catch::Contains("nearer than the gap") && Catch::Contains("the energy has grown"));
}

TEST_CASE("pressure in an open mesh is an error with the body's file and line") {
  const ScratchFolder folder;
  std::ofstream(folder.path / "open.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";
  std::ofstream(folder.path / "open.toml") << "[simulation]\nduration = 0.1\n\n[[body]]\nname = \"bag\"\nmesh = \"open.obj\"\n"
                                              "pressure = 1\n";
  test::check_fails("run " + (folder.path / "open.toml").string() + " --device cpu --out " + folder.path.string(), 3,
                    {"open.toml:4", "bag", "pressure needs a closed mesh", "3 edges"});
}

TEST_CASE("keys that change nothing are named in warnings, and no others") {
  const ScratchFolder folder;
  const auto scene = folder.path / "scene.toml";
  std::ofstream(scene) << "[collision]\nfriction = 0.3\nelasticity = 0.8\n"
                       << "[[body]]\nname = \"soft\"\nmesh = \"icosphere:1\"\ngap = 0.04\nstiffness = 30\n"
                       << "[[body]]\nname = \"wall\"\nmesh = \"icosphere:1\"\nposition = [3, 0, 0]\nvertex_mass = 3\n";
  const auto told = [&](const std::string& options) {
    const ProgramResult result = run_program("run " + scene.string() + " --device cpu --check" + options);
    CAPTURE(result.output);
    CHECK(result.exit_code == 0);
    return result.output;
  };
  const auto count = [](const std::string& text) {
    int found = 0;
    for (std::size_t at = 0; (at = text.find("no effect", at)) != std::string::npos; ++at) ++found;
    return found;
  };
  CHECK(count(told("")) == 0);
  const std::string reflected = told(" --set collision.response=reflect");
  CHECK_THAT(reflected, Catch::Contains("scene.toml:2: collision.friction has no effect with response = \"reflect\"") &&
                            Catch::Contains("scene.toml:7: body.soft.gap has no effect with"));
  CHECK(count(reflected) == 2);
  const std::string still = told(" --set body.wall.kind=static --set body.wall.total_mass=2");
  CHECK_THAT(still, Catch::Contains("body.wall.total_mass has no effect on a static body"));
  CHECK(count(still) == 1);  // the file's vertex_mass is replaced
  CHECK_THAT(told(" --set body.soft.force_tolerance=1e-3 --set body.soft.forces=direct"),
             Catch::Contains("force_tolerance has no effect with forces = \"direct\""));
  CHECK_THAT(told(" --set body.soft.subdivision=loop"), Catch::Contains("subdivision has no effect without subdivide"));
  CHECK_THAT(told(" --set body.soft.pressure_law=constant"), Catch::Contains("pressure_law has no effect without pressure"));
  const std::string of_rows =
      told(" --set body.soft.pressure_law=constant --set body.soft.count=[1,2,1] --set body.soft.spacing=[0,30,0]");
  CHECK(of_rows.find("pressure_law has no effect") == of_rows.rfind("pressure_law has no effect"));
  CHECK_THAT(told(" --set body.soft.pressure_law=constant --set body.soft.pressure=1"), !Catch::Contains("no effect"));
}

TEST_CASE("a duration too short for one step is warned of") {
  const ScratchFolder folder;
  const ProgramResult result =
      run_program("run " + small_scene(folder).string() + " --device cpu --quiet --time-step 1e6 --out " + folder.path.string());
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Catch::Contains("no step is made") && !Catch::Contains("stability bound"));
}

}  // namespace
}  // namespace pliant
