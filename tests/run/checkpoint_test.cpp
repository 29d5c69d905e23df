// Runs that are killed, interrupted or copied, and taken up again.
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>

#include "core/read_text.hpp"
#include "core/version.hpp"
#include "output/checkpoint_file.hpp"
#include "output/file_lock.hpp"
#include "support/checkpointed_runs.hpp"
#include "support/has.hpp"
#include "support/json.hpp"
#include "support/program.hpp"
#include "support/scratch.hpp"

namespace pliant {
namespace {

using test::account_in;
using test::Begun;
using test::ReadJson;
using test::scene_in;
using test::ScratchFolder;
using test::verlet;

void check_same_run(const std::filesystem::path& a, const std::filesystem::path& b) {
  const ReadJson account_of_a = account_in(a), account_of_b = account_in(b);
  CHECK(account_of_a.without("skipped") == account_of_b.without("skipped"));
  CHECK(account_of_a["skipped"].without("quiet_steps") == account_of_b["skipped"].without("quiet_steps"));
  for (const char* name : {"history.csv", "final_state.csv"}) CHECK(read_text(a / name) == read_text(b / name));
  std::size_t frames = 0;
  for (const auto& frame : std::filesystem::directory_iterator(a / "frames")) {
    CHECK(read_text(frame) == read_text(b / "frames" / frame.path().filename()));
    ++frames;
  }
  CHECK(frames > 10);
}

// A run that has been killed leaves whole rows and whole frames, those of the same run that has not.
void check_readable(const std::filesystem::path& killed, const std::filesystem::path& whole) {
  CHECK_FALSE(std::filesystem::exists(killed / "summary.json"));
  const std::string rows = read_text(killed / "history.csv");
  CHECK(rows.ends_with('\n'));
  CHECK(read_text(whole / "history.csv").starts_with(rows));
  for (const auto& frame : std::filesystem::directory_iterator(killed / "frames"))
    if (frame.path().extension() == ".obj") CHECK(read_text(frame) == read_text(whole / "frames" / frame.path().filename()));
}

void check_killed_run(const std::string& simulation, const std::string& options) {
  const ScratchFolder folder;
  const std::string scene = scene_in(folder, simulation).string(), checkpoint = (folder.path / "run.checkpoint").string();
  const auto whole = folder.path / "whole", killed = folder.path / "killed";
  const ProgramResult result = run_program("run " + scene + " --quiet --frames obj --out " + whole.string() + options);
  CAPTURE(result.output);
  REQUIRE(result.exit_code == 0);
  std::vector<std::string> arguments = {"run",          scene,      "--frames",           "obj", "--out", killed.string(),
                                        "--checkpoint", checkpoint, "--checkpoint-every", "0"};
  std::istringstream words(options);
  for (std::string word; words >> word;) arguments.push_back(word);
  ProgramInTerminal program(arguments);
  REQUIRE(program.has_shown_progress(9));
  program.end_by(SIGKILL);
  check_readable(killed, whole);
  std::filesystem::remove(scene);  // the checkpoint holds it
  const ProgramResult resumed = run_program("run --quiet --checkpoint-every 1000 --resume " + checkpoint);
  CAPTURE(resumed.output);
  CHECK(resumed.exit_code == 0);
  check_same_run(whole, killed);
}

TEST_CASE("a run that is killed and resumed ends as one that is not, to the bit") { check_killed_run(verlet, " --device cpu"); }

TEST_CASE("a killed run is resumed with the options it had, in either precision and with steps of adaptive length", "[long]") {
  check_killed_run(verlet, " --device cpu --precision 64 --integrator cv8 --set body.left.stiffness=10");
  check_killed_run("tolerance = 1e-5\nintegrator = \"auto\"\nduration = 2", " --device cpu --duration 3");
}

TEST_CASE("a run on the GPU that is killed and resumed ends as one that is not, to the bit", "[gl][long]") {
  if (test::lacks_gl()) return;
  check_killed_run(verlet, " --device gpu --duration 3");
}

std::size_t count_of(std::string_view part, std::string_view text) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string_view::npos; at += part.size()) ++count;
  return count;
}

TEST_CASE("a body pressed below half its volume is named once, and a resumed run names it no second time") {
  const ScratchFolder folder;
  const std::string checkpoint = (folder.path / "run.checkpoint").string();
  std::vector<std::string> arguments = {"run",          scene_in(folder, verlet).string(),
                                        "--device",     "cpu",
                                        "--frames",     "obj",
                                        "--out",        folder.path.string(),
                                        "--checkpoint", checkpoint};
  for (const std::string body : {"left", "right"})
    for (const char* key : {"pressure=1e-3", "stiffness=1e-3", "stretch=[1,1,0.4]", "velocity=[0,0,0]"}) {
      arguments.push_back("--set");
      arguments.push_back("body." + body + "." + key);
    }
  ProgramInTerminal program(arguments);
  REQUIRE(program.has_shown_progress(9));
  const ProgramResult begun = program.end_by(SIGINT);
  REQUIRE(begun.exit_code == 130);
  const ProgramResult resumed = run_program("run --resume " + checkpoint);
  REQUIRE(resumed.exit_code == 0);
  const std::string told = account_in(folder.path)["warnings"].text();
  for (const std::string body : {"left", "right"}) {
    CAPTURE(begun.output, resumed.output, told);
    const std::string warning = "body \"" + body + "\" was pressed below 0.5 of its rest volume";
    CHECK(count_of(warning, begun.output) == 1);
    CHECK(count_of(warning, resumed.output) == 1);  // as it tells all warnings from before at its beginning
    CHECK(count_of("body \\\"" + body + "\\\" was pressed", told) == 1);
  }
}

TEST_CASE("a run that is interrupted leaves a checkpoint of where it stood, from which it ends as one that is not") {
  const ScratchFolder folder;
  const std::string scene = scene_in(folder, verlet).string(), checkpoint = (folder.path / "run.checkpoint").string();
  const auto whole = folder.path / "whole", part = folder.path / "part";
  REQUIRE(run_program("run " + scene + " --device cpu --quiet --frames ply --out " + whole.string()).exit_code == 0);
  ProgramInTerminal program(
      {"run", scene, "--device", "cpu", "--frames", "ply", "--out", part.string(), "--checkpoint", checkpoint});
  REQUIRE(program.has_shown_progress(9));
  const std::string at_start = read_text(checkpoint);  // five minutes have not passed
  const ProgramResult interrupted = program.end_by(SIGINT);
  CHECK(interrupted.exit_code == 130);
  CHECK_THAT(interrupted.output, Catch::Contains("go on with: pliant run --resume '" + checkpoint));
  const auto steps = account_in(part)["steps"];
  CHECK(steps > 0);
  CHECK(steps < account_in(whole)["steps"]);
  const ProgramResult resumed = run_program("run --resume " + checkpoint);
  REQUIRE(resumed.exit_code == 0);
  CHECK_THAT(resumed.output,
             Catch::StartsWith("going on with " + scene + " at step ") && Catch::Contains(", into " + part.string()));
  check_same_run(whole, part);
  std::ofstream(checkpoint, std::ios::binary) << at_start;
  const ProgramResult again = run_program("run --resume " + checkpoint);
  REQUIRE(again.exit_code == 0);
  CHECK_THAT(again.output, Catch::Contains(" at step 0, into "));
  check_same_run(whole, part);
}

TEST_CASE("a run that is interrupted between the parts of a step goes on there, and ends as one that is not", "[long]") {
  const ScratchFolder folder;
  const std::string scene = (folder.path / "scene.toml").string(), checkpoint = (folder.path / "run.checkpoint").string();
  const double step = 0.02;  // all but the first fall into a hundred parts, and take a third of a second
  std::ofstream(scene)
      << "[simulation]\ntime_step = 0.02\nduration = 0.08\nintegrator = \"verlet\"\n[output]\nframe_rate = 10\n"
      << "[[body]]\nname = \"left\"\nmesh = \"icosphere:3\"\nposition = [-2.2, 0, 0]\nvelocity = [50, 0, 0]\n"
      << "[[body]]\nname = \"right\"\nmesh = \"icosphere:3\"\nposition = [2.2, 0.3, 0]\nvelocity = [-50, 0, 0]\n";
  const auto whole = folder.path / "whole", part = folder.path / "part";
  REQUIRE(run_program("run " + scene + " --device cpu --quiet --out " + whole.string()).exit_code == 0);
  double steps = 0, time = 0;
  // Where processors are busy an interrupt can come just between two steps, try for try. So each try gives the program longer.
  for (int tries = 0; tries < 20 && !(time > step * steps); ++tries) {
    ProgramInTerminal program({"run", scene, "--device", "cpu", "--out", part.string(), "--checkpoint", checkpoint});
    REQUIRE(program.has_shown_progress(1));  // after the first step
    const auto then = std::chrono::steady_clock::now() + tries * std::chrono::milliseconds(3);
    while (std::chrono::steady_clock::now() < then) {
    }
    if (program.end_by(SIGINT).exit_code != 130) continue;  // it was over
    const ReadJson account = account_in(part);
    steps = account["steps"].get<double>();
    time = account["simulated_seconds"].get<double>();
  }
  CAPTURE(steps, time);
  CHECK(steps >= 1);
  CHECK(time > step * steps);
  CHECK(time < step * (steps + 1));
  const ProgramResult resumed = run_program("run --resume " + checkpoint);
  CAPTURE(resumed.output);
  REQUIRE(resumed.exit_code == 0);
  CHECK(account_in(whole) == account_in(part));
  for (const char* name : {"history.csv", "final_state.csv"}) CHECK(read_text(whole / name) == read_text(part / name));
}

TEST_CASE("a run that goes non-finite leaves the checkpoint from before, from which it does so again") {
  const ScratchFolder folder;
  const std::string checkpoint = (folder.path / "run.checkpoint").string(),
                    unstable = "time_step = 1\nduration = 5000\nintegrator = \"rk4\"\ndamping_law = \"none\"";
  const ProgramResult begun = run_program(
      "run " + scene_in(folder, unstable).string() +
      " --device cpu --quiet --set collision.response=none --set body.left.stretch=[1.1,1,1] --checkpoint-every 0 --checkpoint " +
      checkpoint + " --out " + folder.path.string());
  REQUIRE(begun.exit_code == 5);
  const ReadJson account = account_in(folder.path);
  const ProgramResult resumed = run_program("run --resume " + checkpoint);
  CAPTURE(resumed.output);
  CHECK(resumed.exit_code == 5);
  const std::size_t place = resumed.output.find(" at step ");
  REQUIRE(place != std::string::npos);
  CHECK(std::stoull(resumed.output.substr(place + 9)) < account["steps"].get<std::uint64_t>());
  CHECK(account_in(folder.path) == account);
}

TEST_CASE("a run has a checkpoint of its own from its start on, whatever stood there, and a resumed one, too") {
  const Begun begun;
  const std::string scene = scene_in(begun.folder, verlet).string(),
                    begins = " --checkpoint-every 1000 --checkpoint " + begun.checkpoint;
  const auto out = begun.folder.path / "out", other = begun.folder.path / "other";
  REQUIRE(run_program("run " + scene + " --device cpu --quiet --steps 7 --out " + other.string() + begins).exit_code == 0);
  std::filesystem::remove_all(out);
  REQUIRE(begun.resume().exit_code == 0);
  CHECK_FALSE(std::filesystem::exists(out));
  CHECK(account_in(other)["steps"] == 7);
  REQUIRE(begun.resume(" --out " + out.string()).exit_code == 0);
  std::filesystem::remove_all(other);
  REQUIRE(begun.resume().exit_code == 0);
  CHECK_FALSE(std::filesystem::exists(other));
  CHECK(account_in(out)["steps"] == 7);
}

TEST_CASE("a checkpoint that is damaged, cut short or none exits with 3 and changes no file") {
  const Begun begun;
  const std::string whole = read_text(begun.checkpoint);
  for (const auto& [bytes, what] : {std::pair(whole.substr(0, whole.size() / 2), "cut short"),
                                    std::pair(whole.substr(0, whole.size() - 1) + '\x55', "damaged"),
                                    std::pair(std::string("time,energy\n0,1\n"), "no checkpoint")}) {
    std::ofstream(begun.checkpoint, std::ios::binary) << bytes;
    begun.check_refused(3, what);
  }
  write_checkpoint(begun.checkpoint, "a right checksum, but nothing that a checkpoint holds");
  begun.check_refused(3, "bytes are missing");
}

TEST_CASE("a run is not resumed with another mesh, and the error names the body") {
  const ScratchFolder folder;
  const auto mesh = folder.path / "mesh.obj";
  const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  std::ofstream(mesh) << tetrahedron;
  const Begun begun(mesh.string());
  std::ofstream(mesh) << "v 0 0 0.001" + tetrahedron.substr(7);
  begun.check_refused(3, "the mesh of body \"left\" has changed");
  std::ofstream(mesh) << tetrahedron;
  CHECK(begun.resume().exit_code == 0);
}

TEST_CASE("a run is not resumed with other bodies") {
  const Begun begun;
  const std::string body = "[[body]]\nname = \"right\"\nmesh = \"icosphere:1\"\nposition = [1.1, 0, 0]\nstiffness = 20\n";
  begun.replace(body, std::string(body.size() - 1, '#') + '\n');
  begun.check_refused(3, "other bodies");
}

TEST_CASE("a run goes on on another device or at another precision only if told to, with a warning") {
  for (const char* kind : {"cpu", "auto"}) {
    const Begun begun;
    begun.lengthen();
    const std::string device = account_in(begun.folder.path / "out")["device"]["name"].get<std::string>();
    begun.replace(device, std::string(device.size(), 'x'));
    begun.check_refused(4, "its bits would differ");
    const ProgramResult told = begun.resume(std::string(" --device ") + kind);
    CHECK(told.exit_code == 0);
    CHECK_THAT(told.output,
               Catch::Contains("warning: up to step 100 the run was on xxx") && Catch::Contains("its bits differ from there on"));
  }
  const Begun begun;
  begun.lengthen();
  const ProgramResult more = begun.resume(" --precision 64");
  CHECK(more.exit_code == 0);
  CHECK_THAT(more.output, Catch::Contains("from there on it is on") && Catch::Contains("at precision 64"));
}

// What fp32 cannot tell apart would stand still there.
TEST_CASE("a run does not go on at a precision that cannot prove its bodies apart, but it may end") {
  const ScratchFolder folder;
  const std::string scene = (folder.path / "scene.toml").string(), checkpoint = (folder.path / "run.checkpoint").string();
  std::ofstream(scene) << "[simulation]\ntime_step = 0.002\nduration = 0.00\n"
                          "[[body]]\nname = \"left\"\nmesh = \"cube:1\"\nposition = [-0.5000000001, 0, 0]\n"
                          "[[body]]\nname = \"right\"\nmesh = \"cube:1\"\nposition = [0.5000000001, 0, 0]\n";
  const ProgramResult begun = run_program("run " + scene + " --device cpu --precision 64 --quiet --checkpoint " + checkpoint +
                                          " --out " + (folder.path / "out").string());
  CAPTURE(begun.output);
  REQUIRE(begun.exit_code == 0);
  const auto resume = [&](const std::string& options) {
    return run_program("run --quiet --checkpoint-every 0 --resume " + checkpoint + options);
  };
  const std::string fine = read_checkpoint(checkpoint);
  CHECK(resume(" --precision 32").exit_code == 0);  // no step is left
  write_checkpoint(checkpoint, fine);
  const auto lengthen = [&](const std::string& before, const std::string& now) {
    std::string content = read_checkpoint(checkpoint);
    write_checkpoint(checkpoint, content.replace(content.find(before), before.size(), now));
  };
  lengthen("duration = 0.00", "duration = 0.02");
  const ProgramResult coarse = resume(" --precision 32");
  CHECK(coarse.exit_code == 3);
  CHECK_THAT(coarse.output, Catch::Contains("run.checkpoint: bodies \"left\" and \"right\" have come as near as 2e-10 m") &&
                                Catch::Contains("fp32") && Catch::Contains("go on with --precision 64"));
  CHECK(resume("").exit_code == 0);
  lengthen("duration = 0.02", "duration = 0.04");
  CHECK(resume(" --precision 32").exit_code == 0);  // contacts have pushed them apart, and the scene's start does not matter
}

TEST_CASE("a run that is over has no bits that differ elsewhere: resuming it warns of none") {
  for (const std::string length : {"", " --tolerance 1e-5 --integrator vern8"}) {
    const Begun begun("icosphere:1", length);
    begun.replace(commit(), std::string(commit().size(), '9'));
    const ProgramResult result = begun.resume(" --precision 64");
    CHECK(result.exit_code == 0);
    CHECK(result.output.empty());
    CHECK(account_in(begun.folder.path / "out")["warnings"].empty());
  }
}

TEST_CASE("warnings stay with a run, however often it is resumed, and are told once") {
  const Begun begun("icosphere:1", " --tolerance 1e-5");
  const auto warnings = [&] { return account_in(begun.folder.path / "out")["warnings"]; };
  const auto before = warnings();
  REQUIRE(before.size() == 1);  // about an integrator that can't meet it
  begun.lengthen();
  REQUIRE(begun.resume(" --precision 64").exit_code == 0);
  const auto after = warnings();
  REQUIRE(after.size() == 2);
  CHECK(after[0] == before[0]);
  CHECK_THAT(after[1].get<std::string>(), Catch::Contains("at precision 64"));
  REQUIRE(begun.resume().exit_code == 0);
  CHECK(warnings() == after);
}

TEST_CASE("a run at precision 64 goes on on a GPU, which knows 32 alone", "[gl]") {
  if (test::lacks_gl()) return;
  const Begun begun("icosphere:1", " --precision 64");
  begun.lengthen();
  const ProgramResult result = begun.resume(" --device gpu");
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Catch::Contains("at precision 64, and from there on it is on") && Catch::Contains("at precision 32"));
}

TEST_CASE("a run at precision 64 stays so on the device that fits best, which is the CPU") {
  const ProgramResult result = Begun("icosphere:1", " --precision 64").resume(" --device auto");
  CHECK(result.exit_code == 0);
  CHECK(result.output.empty());
}

TEST_CASE("a run begun by a pliant of another version or another commit goes on with a warning") {
  for (const std::string& part : {version(), commit()}) {
    const Begun begun;
    begun.lengthen();
    const std::string other(part.size(), '9');
    begun.replace(part, other);
    const ProgramResult result = begun.resume();
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.output, Catch::Contains("the run was by pliant") && Catch::Contains(other));
  }
  const Begun same;
  same.lengthen();
  CHECK(same.resume().output.empty());
}

TEST_CASE("the times of loading and building are sums over all parts of a run, as others are") {
  const Begun begun;
  const auto timings = [&] { return ReadJson::parse(read_text(begun.folder.path / "out/summary.json"))["timings_ms"]; };
  const auto before = timings();
  REQUIRE(begun.resume().exit_code == 0);
  for (const char* part : {"load", "build"}) CHECK(timings()[part] > before[part]);
}

TEST_CASE("a run can go on in another folder, with the whole history") {
  const Begun begun;
  const auto out = begun.folder.path / "out", other = begun.folder.path / "other";
  REQUIRE(begun.resume(" --out " + other.string()).exit_code == 0);
  for (const char* name : {"history.csv", "final_state.csv"}) CHECK(read_text(out / name) == read_text(other / name));
}

TEST_CASE("places of a run stay where they were for one who resumes it elsewhere, and move with a folder that was moved") {
  const ScratchFolder folder;
  const auto old = folder.path / "old", moved = folder.path / "moved";
  std::filesystem::create_directory(old);
  std::ofstream(old / "mesh.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  std::ofstream(old / "scene.toml") << "[[body]]\nmesh = \"mesh.obj\"\n";
  const std::string begun = "run scene.toml --device cpu --steps 3 --out out --checkpoint c", resumed = "run --resume ../c";
  REQUIRE(run_program(begun + " --quiet", "cd " + old.string() + " && ").exit_code == 0);
  std::filesystem::copy_file(old / "c", folder.path / "c");
  std::filesystem::remove_all(old / "out");
  std::filesystem::create_directory(moved);
  CHECK(run_program(resumed, "cd " + moved.string() + " && ").exit_code == 0);
  CHECK(std::filesystem::exists(old / "out/summary.json"));
  std::filesystem::remove(moved);
  std::filesystem::rename(old, moved);  // and the checkpoint is of a run that was resumed elsewhere
  std::filesystem::remove_all(moved / "out");
  const ProgramResult result = run_program(resumed, "cd " + moved.string() + " && ");
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Catch::Contains("going on with scene.toml at step 0, into out\n"));
  CHECK(std::filesystem::exists(moved / "out/summary.json"));
  CHECK_FALSE(std::filesystem::exists(old));
  CHECK(run_program("run --resume c --out new", "cd " + folder.path.string() + " && ").exit_code == 0);
  CHECK(std::filesystem::exists(folder.path / "new/summary.json"));
}

TEST_CASE("options that a resumed run can't follow, or that lack their counterpart, exit with 2") {
  const Begun begun;
  const std::string scene = (begun.folder.path / "scene.toml").string();
  const auto check_refused = [](const std::string& arguments, const char* what) {
    const ProgramResult result = run_program("run " + arguments);
    CAPTURE(arguments, result.output);
    CHECK(result.exit_code == 2);
    CHECK_THAT(result.output, Catch::Contains(what));
  };
  for (const std::string option : {"--steps 3", "--duration 1", "--time-step 1", "--tolerance 1e-6", "--integrator rk4",
                                   "--set simulation.duration=9", "--frames png", "--video x.mp4", "--timings", "--check"})
    check_refused("--resume " + begun.checkpoint + " " + option, "--resume");
  check_refused(scene + " --resume " + begun.checkpoint, "--resume");
  check_refused(scene + " --checkpoint-every 5", "--checkpoint");
  check_refused(scene + " --checkpoint-every -1 --checkpoint x", "--checkpoint-every");
  check_refused(scene + " --device cpu --checkpoint /dev/null/x --out " + begun.folder.path.string(), "/dev/null/x");
  CHECK_FALSE(std::filesystem::exists(begun.folder.path / "summary.json"));
}

TEST_CASE("a final state that can't be written leaves the one before, a summary, and exit code 2") {
  const ScratchFolder folder;
  const auto state = folder.path / "final_state.csv";
  std::ofstream(state) << "earlier";
  const ProgramResult result = run_program(
      "run " + scene_in(folder, verlet).string() + " --device cpu --duration 0.1 --quiet --out " + folder.path.string(),
      "trap '' XFSZ; ulimit -f 8; ");
  CAPTURE(result.output);
  CHECK(result.exit_code == 2);
  CHECK_THAT(result.output, Catch::Contains("final_state.csv") && Catch::Contains("can't be written to the end") &&
                                Catch::Contains("left there by an earlier run: final_state.csv; all else is of this one"));
  CHECK(read_text(state) == "earlier");
  CHECK(account_in(folder.path)["steps"] == 50);
}

TEST_CASE("a run whose working folder goes writes checkpoints and is resumed from them all the same") {
  const ScratchFolder folder;
  const std::string scene = scene_in(folder, verlet).string(), gone = (folder.path / "gone").string();
  const auto out = folder.path / "out", checkpoint = folder.path / "run.checkpoint";
  for (const std::string& command : {"run " + scene + " --device cpu --duration 0.2 --quiet --checkpoint-every 0 --checkpoint " +
                                         checkpoint.string() + " --out " + out.string(),
                                     "run --quiet --resume " + checkpoint.string()}) {
    std::filesystem::create_directory(gone);
    const ProgramResult result = run_program(command, "cd " + gone + " && rmdir " + gone + " && ");
    CAPTURE(command, result.output);
    CHECK(result.exit_code == 0);
    CHECK(std::filesystem::exists(checkpoint));
  }
}

}  // namespace
}  // namespace pliant
