// `pliant bench` as scripts use it.
#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>

#include "core/read_text.hpp"
#include "gl/context.hpp"
#include "support/has.hpp"
#include "support/json.hpp"
#include "support/paths.hpp"
#include "support/program.hpp"
#include "support/scratch.hpp"

namespace pliant {
namespace {

using test::ReadJson;
using test::ScratchFolder;

bool has_half_a_file(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().filename().string().find(".tmp") != std::string::npos) return true;
  return false;
}

ReadJson checked_results(const std::string& arguments, const std::filesystem::path& file) {
  const ProgramResult result = run_program("bench " + arguments + " --quick --json " + file.string());
  CAPTURE(result.output);
  REQUIRE(result.exit_code == 0);
  const auto json = ReadJson::parse(read_text(file));
  const auto& machine = json["machine"];
  for (const char* key : {"cpu", "gpu", "driver", "compiler", "date"}) CHECK(machine.contains(key));
  CHECK_THAT(machine["commit"].get<std::string>(), Catch::Matches("unknown|[0-9a-f]{12,40}(-dirty)?"));
  CHECK(run_program("--version").output == machine["version"].get<std::string>() + '\n');
  for (const char* key : {"version", "commit", "cpu", "date"})  // they stand above the table, too
    CHECK_THAT(result.output, Catch::Contains(machine[key].get<std::string>()));
  CHECK_THAT(json["machine"]["date"].get<std::string>(), Catch::Matches("\\d{4}-\\d\\d-\\d\\dT\\d\\d:\\d\\d:\\d\\dZ"));
  CHECK_FALSE(json["rows"].empty());
  CHECK(json["options"]["quick"] == true);
  CHECK(json["interrupted"] == false);
  CHECK_FALSE(has_half_a_file(file.parent_path()));
  return json;
}

void check_fails(const std::string& arguments, int exit_code, const char* part) {
  CAPTURE(arguments);
  const ProgramResult result = run_program("bench " + arguments);
  CHECK(result.exit_code == exit_code);
  CHECK_THAT(result.output, Catch::Contains(part));
}

TEST_CASE("bench contact makes one study alone if it is asked to, and says which") {
  const ScratchFolder folder;
  const auto json = checked_results("contact --only cost --device cpu --threads 1", folder.path / "contact.json");
  CHECK(json["options"]["only"] == "cost");
  for (const auto& row : json["rows"]) CHECK(row["kind"] == "cost");
  check_fails("contact --only price", 2, "price not in {apart,impacts,rest,cost,self}");
  if (!test::lacks_gl()) check_fails("contact --only impacts --device gpu", 2, "measured on the CPU alone");
}

TEST_CASE("bench forces writes every key of its rows, into a folder that it makes") {
  const ScratchFolder folder;
  const auto json = checked_results("forces --device cpu --threads 1", folder.path / "new" / "forces.json");
  CHECK(json["suite"] == "forces");
  for (const auto& row : json["rows"]) {
    for (const char* key : {"device", "isa", "form"}) CHECK(row[key].is_string());
    for (const char* key : {"precision", "threads", "vertices"}) CHECK(row[key].is_number_unsigned());
    for (const char* key : {"pairs_per_second", "bound_pairs_per_second"}) CHECK(row[key].get<double>() > 0);
  }
}

TEST_CASE("bench dense writes every key of its rows, and forces by clusters are near exact ones") {
  const ScratchFolder folder;
  const auto json = checked_results("dense --device cpu --threads 1", folder.path / "dense.json");
  CHECK(json["suite"] == "dense");
  REQUIRE(json["rows"].size() > 0);
  for (const auto& row : json["rows"]) {
    for (const char* key : {"mesh", "deformation"}) CHECK(row[key].is_string());
    const auto deformation = row["deformation"].get<std::string>();
    if (deformation != "flat" && deformation != "poke") CHECK(row["error"].get<double>() < 3e-3);
    CHECK(row["error"].get<double>() > 0);
    CHECK(row["springs_per_vertex"].get<double>() < row["vertices"].get<double>() / 2);
  }
  REQUIRE(json["forces"].size() == 4);  // two sizes in two precisions
  for (const auto& row : json["forces"]) {
    CHECK(row["contact_share"].get<double>() > 0.5);
    for (const char* key : {"error", "list_seconds", "seconds_per_sum", "direct_seconds_per_sum", "seconds_per_step",
                            "direct_seconds_per_step", "seconds_per_contact_step", "bytes_per_vertex"})
      CHECK(row[key].get<double>() > 0);
  }
}

TEST_CASE("bench steps writes every key of its rows, for the scenes of a folder") {
  const ScratchFolder folder;
  std::ofstream(folder.path / "small.toml") << "[simulation]\ntime_step = 0.01\nduration = 0.05\n"
                                               "[[body]]\nmesh = \"icosphere:1\"\nposition = [-1, 0, 0]\nvelocity = [4, 0, 0]\n"
                                               "[[body]]\nmesh = \"icosphere:1\"\nposition = [1, 0, 0]\nforces = \"clustered\"\n";
  const auto json =
      checked_results("steps --device cpu --threads 2 --scenes " + folder.path.string(), folder.path / "steps.json");
  CHECK(json["suite"] == "steps");
  CHECK(json["rows"].size() == 2);   // one thread and two
  CHECK(json["notes"].size() == 2);  // the families: one without a scene, one too large
  CHECK(json.contains("crossovers"));
  for (const auto& row : json["rows"]) {
    CHECK(row["scene"] == "small");
    CHECK(row["vertices"] == 84);
    CHECK(row["bodies"] == 2);
    CHECK(row["clustered_bodies"] == 1);
    CHECK(row["steps"] == 5);
    for (const char* key : {"device", "precision", "threads", "contact_steps", "steps_per_second"}) CHECK(row.contains(key));
    CHECK(row["milliseconds_per_step"].get<double>() > 0);
  }
}

TEST_CASE("a wrong command line of bench exits with 2 before anything is measured") {
  const ScratchFolder folder;
  check_fails("", 2, "pliant: pliant bench needs a subcommand: forces");
  check_fails("everything", 2, "there is no \"pliant bench everything\"");
  check_fails("--json", 2, "pliant bench has no option --json");
  check_fails("forces --device tpu", 2, "--device");
  check_fails("forces --threads 0", 2, "--threads");
  check_fails("forces --scenes scenes", 2, "--scenes");
  check_fails("forces --device cpu --gpu 0", 2, "--gpu");
  check_fails("steps --device cpu --scenes " + folder.path.string(), 2, "no scenes");
  check_fails("contact --device cpu --scenes " + folder.path.string(), 2, "no scenes");
  CHECK(run_program("bench steps --scenes " + folder.path.string()).output.starts_with("pliant: --scenes: no scenes"));
  check_fails("forces --device cpu --json \"\"", 2, "--json: is empty");
  check_fails("forces --device cpu --json /proc/none/forces.json", 2, "/proc/none/forces.json");
}

TEST_CASE("an earlier result stays where nothing is measured") {
  const ScratchFolder folder;
  const auto file = folder.path / "results.json";
  std::ofstream(file) << "earlier";
  const std::string json = " --json " + file.string();
  check_fails("forces --quick --device gpu --gpu 99" + json, 4, "GPU");
  check_fails("steps --quick --device cpu --scenes " + (folder.path / "none").string() + json, 2, "no scenes");
  CHECK(read_text(file) == "earlier");
  CHECK_FALSE(has_half_a_file(file.parent_path()));
}

TEST_CASE("a full disk is told after the table") {
  const ProgramResult result = run_program("bench forces --quick --device cpu --threads 1 --json /dev/full");
  CHECK(result.exit_code == 2);
  CHECK(result.output.find("us a sum") < result.output.find("/dev/full"));
  CHECK(result.output.find("/dev/full") != std::string::npos);
}

TEST_CASE("results are written where standard output can't be") {
  const ScratchFolder folder;
  const auto file = folder.path / "results.json";
  const ProgramResult result =
      run_program("bench collision --quick --device cpu --threads 1 --json " + file.string() + " > /dev/full");
  CHECK(result.exit_code == 2);
  CHECK_THAT(read_text(file), Catch::Contains("\"collision\""));
}

// The program shows progress before each row.
TEST_CASE("Ctrl-C and SIGTERM end bench early, and an earlier result gives way to finished rows alone") {
  for (const int signal : {SIGINT, SIGTERM})
    for (const int shown : {1, 3}) {
      CAPTURE(signal, shown);
      const ScratchFolder folder;
      const auto file = folder.path / "forces.json";
      std::ofstream(file) << "earlier";
      ProgramInTerminal program({"bench", "forces", "--device", "cpu", "--threads", "1", "--json", file.string()});
      REQUIRE(program.has_shown_progress(shown));
      CHECK_FALSE(has_half_a_file(file.parent_path()));  // a program that is killed would leave one
      const ProgramResult result = program.end_by(signal);
      CAPTURE(result.output);
      CHECK(result.exit_code == 130);
      CHECK_FALSE(has_half_a_file(file.parent_path()));
      const std::string told = "interrupted after ";
      REQUIRE(result.output.find(told) != std::string::npos);
      const int rows = std::stoi(result.output.substr(result.output.find(told) + told.size()));
      CHECK(rows >= shown - 1);
      CHECK((read_text(file) == "earlier") == (rows == 0));
      if (rows == 0) continue;
      const auto json = ReadJson::parse(read_text(file));
      CHECK(json["interrupted"] == true);
      CHECK(json["rows"].size() == static_cast<std::size_t>(rows));
    }
}

TEST_CASE("a GPU that is not there exits with 4") { check_fails("forces --quick --device gpu --gpu 99", 4, "GPU"); }

}  // namespace
}  // namespace pliant
