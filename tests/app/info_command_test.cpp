// What the program says of this machine and of its methods.
#include <catch2/catch.hpp>

#include "gl/context.hpp"
#include "support/json.hpp"
#include "support/program.hpp"
#include "support/scratch.hpp"

namespace pliant {

TEST_CASE("info lists devices and integrators") {
  const auto devices = test::ReadJson::parse(run_program("info --json").output);
  CHECK(devices["cpu"]["threads"] >= 1);
  CHECK(devices["gpus"].size() == gl::list_adapters().size());
  const auto integrators = test::ReadJson::parse(run_program("info --integrators --json").output);
  std::vector<std::string> names, meeting_tolerances;
  for (const auto& row : integrators) {
    names.push_back(row["name"].get<std::string>());
    if (row["tolerance"].get<bool>()) meeting_tolerances.push_back(row["name"].get<std::string>());
  }
  CHECK(names == std::vector<std::string>{"verlet", "rk4", "srkn11b", "cv8", "cv8_minus", "dop853", "verner78_8", "vern8",
                                          "dprkn8", "dprkn12"});
  CHECK(meeting_tolerances == std::vector<std::string>{"dop853", "verner78_8", "vern8", "dprkn8", "dprkn12"});
  const std::string table = run_program("info --integrators").output;
  CHECK_THAT(table, Catch::Contains("tolerance") && Catch::Contains("\"auto\"") && Catch::Contains("squashed"));
  CHECK(run_program("--version").exit_code == 0);
  CHECK(run_program("--help").exit_code == 0);
}

TEST_CASE("PLIANT_ISA names the instruction set that a run and info say they use") {
  const auto cpu_with = [](const std::string& isa) {
    return test::ReadJson::parse(run_program("info --json", "PLIANT_ISA=" + isa + " ").output)["cpu"];
  };
  const test::ReadJson any = cpu_with("");
  CHECK(any["instruction_sets"][0] == "portable");
  CHECK(cpu_with("portable")["instruction_sets"] == std::vector<test::ReadJson>{"portable"});
  CHECK(cpu_with(any["instruction_sets"].back().get<std::string>()) == any);
  const std::string name = cpu_with("portable")["name"].get<std::string>();
  CHECK_THAT(name, Catch::EndsWith("baseline vectors"));
  const test::ScratchFolder folder;
  const ProgramResult run = run_program(
      "run " + shipped_scene("two_spheres") + " --device cpu --steps 1 --out " + folder.path.string(), "PLIANT_ISA=portable ");
  CHECK(run.exit_code == 0);
  CHECK_THAT(run.output, Catch::Contains(name));
}

TEST_CASE("an instruction set that the machine does not have ends with exit code 4") {
  for (const std::string& arguments : {std::string("info"), "run --device cpu --steps 1 " + shipped_scene("two_spheres")}) {
    const ProgramResult result = run_program(arguments, "PLIANT_ISA=avx1024 ");
    CHECK(result.exit_code == 4);
    CHECK_THAT(result.output, Catch::Contains("PLIANT_ISA") && Catch::Contains("avx1024") && Catch::Contains("portable"));
  }
}

}  // namespace pliant
