// Parses the command line and runs a command. Returns its exit code.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "app/bench_command.hpp"
#include "app/failures.hpp"
#include "app/info_command.hpp"
#include "app/mesh_command.hpp"
#include "app/run_command.hpp"
#include "app/sweep_command.hpp"
#include "app/view_command.hpp"
#include "core/error.hpp"
#include "core/version.hpp"
#include "run/checkpoint.hpp"
#include "run/run_scene.hpp"
#include "simulation/skipping.hpp"

namespace {

using namespace pliant;

template <class T>
std::string complaint_of_range(const std::string& text, T value, T lowest, T highest) {
  if (value < lowest) return fmt::format("{} is below {}", text, lowest);
  return value > highest ? fmt::format("{} is above {}", text, highest) : "";
}

// CLI11's own checks let nan and inf pass, and call a word that is not a number out of range.
CLI::Validator number(double lowest, double highest) {
  const auto complaint = [lowest, highest](const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    const bool is_number = !text.empty() && *end == '\0' && !std::isnan(value);
    return is_number ? complaint_of_range(text, value, lowest, highest) : fmt::format("\"{}\" is no number", text);
  };
  return {complaint, fmt::format("{} to {}", lowest, highest)};
}

// Serves transform(): reads a decimal number and rewrites it without leading zeros, because CLI11 takes those for octal.
CLI::Validator whole_number(std::int64_t lowest, std::int64_t highest) {
  const auto complaint = [lowest, highest](std::string& text) {
    std::int64_t value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size() || status == std::errc::invalid_argument)
      return fmt::format("\"{}\" is no whole number", text);
    if (status != std::errc()) return text + " is out of range";
    const std::string given = std::exchange(text, std::to_string(value));
    return complaint_of_range(given, value, lowest, highest);
  };
  return {complaint, fmt::format("{} to {}", lowest, highest)};
}

CLI::Validator not_empty(const char* remedy = "name a place") {
  return {[remedy](const std::string& text) { return text.empty() ? fmt::format("is empty; {}", remedy) : std::string(); }, ""};
}

// Adds an option that takes one of a few words.
template <class T>
void add_choice(CLI::App& app, const char* name, T& value, const std::vector<std::pair<std::string, T>>& choices,
                const char* help) {
  std::vector<std::string> words;
  for (const auto& [word, meaning] : choices) words.push_back(word);
  const auto set = [&value, choices](const std::string& text) {
    for (const auto& [word, meaning] : choices)
      if (word == text) value = meaning;
  };
  app.add_option_function<std::string>(name, set, help)->check(CLI::IsMember(words));
}

void add_device(CLI::App& command, DeviceChoice& choice) {
  add_choice<std::optional<DeviceWish>>(command, "--device", choice.wish,
                                        {{"auto", DeviceWish::automatic}, {"cpu", DeviceWish::cpu}, {"gpu", DeviceWish::gpu}},
                                        "Where to simulate (default auto: a hardware GPU, else the CPU)");
  command.add_option("--precision", choice.precision, "Bits of the forces; 64 needs the CPU")->check(CLI::IsMember({32, 64}));
  command.add_option("--threads", choice.threads, "Threads of the CPU (default: one a processor)")
      ->transform(whole_number(1, 4096));
}

void add_overrides(CLI::App& command, std::vector<std::string>& overrides) {
  command.add_option("--set", overrides, "Replace a value of the scene: section.key=value or body.NAME.key=value")
      ->allow_extra_args(false)
      ->take_all();
}

void add_length(CLI::App& run, RunOptions& options) {
  CLI::Option* steps = run.add_option("--steps", options.steps, "Number of steps, instead of the scene's duration")
                           ->transform(whole_number(0, 300'000'000));
  run.add_option("--duration", options.duration, "Simulated time [s]")->check(number(0, 1e30))->excludes(steps);
  CLI::Option* time_step = run.add_option("--time-step", options.time_step, "Length of a step [s]")->check(number(1e-30, 1e30));
  run.add_option("--tolerance", options.tolerance, "Largest error of a step; each step then gets a length that meets it")
      ->check(number(1e-14, 0.1))
      ->excludes(time_step)
      ->excludes(steps);
  run.add_option("--integrator", options.integrator,
                 "Integrator; `pliant info --integrators` lists them, and auto chooses one for a tolerance");
}

void add_outputs(CLI::App& run, RunOptions& options) {
  run.add_option("--out", options.out, "Folder to write (default out/SCENE)")->check(not_empty());
  add_choice<FrameFormat>(run, "--frames", options.frames,
                          {{"none", FrameFormat::none},
                           {"png", FrameFormat::png},
                           {"obj", FrameFormat::obj},
                           {"ply", FrameFormat::ply},
                           {"vtk", FrameFormat::vtk}},
                          "What to write for each frame (default none)");
  run.add_option("--video", options.video,
                 "Video file to draw frames into: mp4, mkv or mov (needs ffmpeg; without it PNG frames are written)")
      ->check(not_empty())
      ->excludes(run.get_option("--frames"));
}

void add_checkpoints(CLI::App& run, RunOptions& options) {
  CLI::Option* checkpoint =
      run.add_option("--checkpoint", options.checkpoint, "File to save the run to now and then, for --resume")
          ->check(not_empty());
  checkpoint->excludes(run.get_option("--video"));
  run.add_option("--checkpoint-every", options.checkpoint_interval,
                 "Wall time between checkpoints [s]: how much work a crash may cost (default 300)")
      ->check(number(0, 1e9));
  run.add_option(
         "--resume", options.resume,
         "Checkpoint to go on from, instead of a scene. The run goes on as if it had not stopped, to the bit, and keeps writing "
         "checkpoints there")
      ->check(not_empty());
}

void refuse_beside_resume(CLI::App& run) {
  CLI::Option* resume = run.get_option("--resume");
  const auto allowed = options_beside_resume();
  const auto is_refused = [&](const CLI::Option* option) {
    return option != resume && option != run.get_help_ptr() &&
           std::ranges::find(allowed, option->get_name(), &OptionBesideResume::name) == allowed.end();
  };
  for (CLI::Option* option : run.get_options(is_refused)) resume->excludes(option);
}

void expect_beginning(const CLI::App& run) {
  const auto is_given = [&](const char* name) { return run.count(name) > 0; };
  if (!is_given("scene") && !is_given("--resume")) throw CLI::RequiredError("scene, or --resume,");
  if (is_given("--checkpoint-every") && !is_given("--checkpoint") && !is_given("--resume"))
    throw CLI::RequiresError("--checkpoint-every", "--checkpoint");
}

// Returns the kinds of work that a run is told to do. The option adds one each time it is given, or all of them.
std::shared_ptr<const std::vector<std::string>> add_skipping(CLI::App& run) {
  std::vector<std::string> names;
  for (const SkippingKind& kind : skipping_kinds) names.emplace_back(kind.name);
  const std::string help = fmt::format("Also do what is known to change nothing, or only =KIND of it ({}), with the same results",
                                       fmt::join(names, ", "));
  names.emplace_back(all_skipping_kinds);
  const auto given = std::make_shared<std::vector<std::string>>();
  run.add_flag(fmt::format("--no-skipping{{{}}}", all_skipping_kinds), *given, help)->check(CLI::IsMember(names));
  return given;
}

void add_run(CLI::App& program, RunOptions& options) {
  CLI::App* run = program.add_subcommand("run", "Simulate a scene and write pictures and numbers");
  run->add_option("scene", options.scene, "Scene file (TOML)")->check(not_empty("name a file"));
  add_device(*run, options.device);
  run->add_option("--gpu", options.device.gpu_index, "Which GPU, as `pliant info` numbers them")
      ->transform(whole_number(0, 1000000));
  add_length(*run, options);
  add_overrides(*run, options.overrides);
  add_outputs(*run, options);
  add_checkpoints(*run, options);
  run->add_flag("--timings", options.timings, "Measure and show what each pass of a step takes; slows the run a little")
      ->excludes(run->get_option("--checkpoint"));
  const auto unskipped = add_skipping(*run);
  run->add_flag("--check", options.check, "Only validate, and estimate time and memory");
  run->add_flag("--quiet", options.quiet, "Print warnings and errors only");
  refuse_beside_resume(*run);
  run->callback([run, unskipped, &options] {
    expect_beginning(*run);
    options.skipping = skipping_without(*unskipped);
  });
}

void add_view(CLI::App& program, app::ViewOptions& options) {
  CLI::App* view = program.add_subcommand("view", "Simulate a scene in a window, live");
  view->footer(app::view_help());
  view->add_option("scene", options.scene,
                   "Scene file (TOML), or a mesh (OBJ); without one a start page has demos to choose from")
      ->check(not_empty("name a file"));
  add_device(*view, options.device);
  add_overrides(*view, options.overrides);
  view->add_option("--speed", options.speed, "Simulated time in a second of real time [s] (default 1)")->check(number(1e-6, 1e6));
  view->add_flag("--paused", options.starts_paused, "Wait at the start for the space bar");
  view->add_option("--report", options.report, "File for a line of JSON a picture, for tests")->check(not_empty())->group("");
}

void add_info(CLI::App& program, app::InfoOptions& options) {
  CLI::App* info = program.add_subcommand("info", "Show devices, or integrators");
  info->add_flag("--json", options.json, "As JSON");
  info->add_flag("--integrators", options.integrators, "List the integrators");
}

CLI::App* add_suite(CLI::App& bench, app::BenchOptions& options, app::BenchSuite which, const char* name, const char* help) {
  CLI::App* suite = bench.add_subcommand(name, help);
  suite->callback([&options, which] { options.suite = which; });
  suite->add_option("--gpu", options.gpu_index, "Which GPU, as `pliant info` numbers them")->transform(whole_number(0, 1000000));
  suite->add_option("--json", options.json, "File to write the results to")->check(not_empty());
  suite->add_flag("--quick", options.quick,
                  "Measure roughly: seconds for forces, contact, collision, dense and draw, one to three minutes for precision "
                  "and stability. The suite steps leaves out what takes over a second");
  return suite;
}

CLI::App* add_device_suite(CLI::App& bench, app::BenchOptions& options, app::BenchSuite which, const char* name,
                           const char* help) {
  CLI::App* suite = add_suite(bench, options, which, name, help);
  add_choice<app::BenchDevices>(*suite, "--device", options.devices,
                                {{"auto", app::BenchDevices::automatic},
                                 {"cpu", app::BenchDevices::cpu},
                                 {"gpu", app::BenchDevices::gpu},
                                 {"all", app::BenchDevices::all}},
                                "What to measure on (default auto: the CPU, and a hardware GPU if there is one)");
  suite
      ->add_option("--threads", options.threads,
                   "Most threads of the CPU; one thread is measured, too (default: one a processor)")
      ->transform(whole_number(1, 4096));
  return suite;
}

void add_draw_suite(CLI::App& bench, app::BenchOptions& options) {
  CLI::App* draw =
      add_suite(bench, options, app::BenchSuite::draw, "draw", "GPU time of a picture and its passes, for each scene");
  draw->add_option("--scenes", options.scenes, "Folder of scenes (default scenes)");
  draw->add_option("--size", options.size, "Width and height of the picture [pixels] (default 1920 1080)")
      ->transform(whole_number(1, 16384));
}

void add_bench(CLI::App& program, app::BenchOptions& options) {
  CLI::App* bench = program.add_subcommand(
      "bench",
      "Measure how fast this machine is; suites are forces, steps, precision, stability, contact, collision, dense, drops, draw");
  bench->require_subcommand(1);
  CLI::App* forces = add_device_suite(*bench, options, app::BenchSuite::forces, "forces",
                                      "Spring forces by size of the body, beside what the hardware allows");
  forces->add_flag("--all-variants", options.all_variants, "Every way of summing forces, instead of the GPU's best one");
  CLI::App* steps = add_device_suite(*bench, options, app::BenchSuite::steps, "steps",
                                     "Whole steps of scenes, and of ever denser bodies in contact");
  steps->add_option("--scenes", options.scenes, "Folder of scenes (default scenes)");
  CLI::App* precision = add_device_suite(*bench, options, app::BenchSuite::precision, "precision",
                                         "Run time against error, beside other libraries' integrators");
  precision->add_option("--scenes", options.scenes, "Folder of scenes, for the bunny (default scenes)");
  add_device_suite(*bench, options, app::BenchSuite::stability, "stability",
                   "Steps at which methods blow up, drift of energy, and errors of fp32");
  CLI::App* contact = add_device_suite(*bench, options, app::BenchSuite::contact, "contact",
                                       "Contact by impulses: whether bodies stay apart, what impacts give, and what they cost");
  contact->add_option("--scenes", options.scenes, "Folder of scenes, for meshes beside it (default scenes)");
  add_choice<app::BenchStudy>(*contact, "--only", options.only,
                              {{"apart", app::BenchStudy::apart},
                               {"impacts", app::BenchStudy::impacts},
                               {"rest", app::BenchStudy::rest},
                               {"cost", app::BenchStudy::cost},
                               {"self", app::BenchStudy::self}},
                              "One study alone");
  add_device_suite(
      *bench, options, app::BenchSuite::collision, "collision",
      "Finding all pairs of triangles that touch, beside other libraries' trees, and steps in contact by their passes");
  CLI::App* dense =
      add_device_suite(*bench, options, app::BenchSuite::dense, "dense",
                       "Springs of dense bodies by clusters: errors for how many springs, and times beside all springs");
  dense->add_option("--scenes", options.scenes, "Folder of scenes, for the bunny beside it (default scenes)");
  CLI::App* drops = add_device_suite(*bench, options, app::BenchSuite::drops, "drops",
                                     "Soft bodies that fall on a floor, beside Bullet's: time, space, volume and energy");
  drops->add_option("--scenes", options.scenes, "Folder of scenes, for the bunny beside it (default scenes)");
  add_draw_suite(*bench, options);
}

void add_mesh(CLI::App& program, app::MeshOptions& options) {
  CLI::App* mesh = program.add_subcommand("mesh", "Report what a mesh consists of and what is wrong with it, or subdivide it");
  mesh->add_option("mesh", options.mesh, "OBJ file, or generator such as icosphere:3")
      ->required()
      ->check(not_empty("name a file or a generator"));
  mesh->add_flag("--json", options.json, "As JSON");
  CLI::Option* subdivide =
      mesh->add_option("--subdivide", options.subdivide, "How often to split each triangle in four, before the report")
          ->transform(whole_number(0, most_subdivisions));
  add_choice<Subdivision>(*mesh, "--subdivision", options.subdivision,
                          {{"midpoint", Subdivision::midpoint}, {"loop", Subdivision::loop}},
                          "How to subdivide: midpoint keeps the surface (default), loop makes it smooth");
  mesh->get_option("--subdivision")->needs(subdivide);
  mesh->add_option("--out", options.out, "File to write the mesh to: obj or ply")->check(not_empty());
}

// The Python package reads its options.
void add_sweep(CLI::App& program) {
  CLI::App* sweep = program.add_subcommand("sweep", "Make many runs of a scene side by side (needs the Python package)");
  sweep->prefix_command();
  sweep->set_help_flag();
}

// Returns the command that was being read, and its name.
std::pair<const CLI::App*, std::string> command_in(const CLI::App* program) {
  std::string name = "pliant";
  while (!program->get_subcommands().empty()) {
    program = program->get_subcommands().front();
    name += " " + program->get_name();
  }
  return {program, name};
}

// If an option is given twice, CLI11 says "--steps: At Most 1 required but received 2".
std::string complaint_of_count(const std::string& text) {
  const auto at = text.find(": At Most 1 required but received ");
  if (at == std::string::npos) return text;
  return fmt::format("{}: is given {} times; give it once", text.substr(0, at), text.substr(text.rfind(' ') + 1));
}

// Names the unknown subcommand or option. CLI11 only asks for a subcommand.
std::string complaint_of(const CLI::App* program, const CLI::Error& error) {
  const auto [command, name] = command_in(program);
  std::string choices;
  for (const CLI::App* choice : command->get_subcommands({})) choices += (choices.empty() ? "" : ", ") + choice->get_name();
  const std::vector<std::string> unknown = command->remaining();
  const auto what = [&]() -> std::string {
    if (choices.empty()) return complaint_of_count(error.what());
    if (unknown.empty()) return fmt::format("{} needs a subcommand: {}", name, choices);
    if (unknown.front().starts_with('-')) return fmt::format("{} has no option {}", name, unknown.front());
    return fmt::format("there is no \"{} {}\"; what exists: {}", name, unknown.front(), choices);
  };
  return fmt::format("pliant: {}; `{} --help` says more\n", what(), name);
}

int execute(int count, char** arguments) {
  CLI::App program{"pliant: soft bodies of all-pairs springs, on GPU and CPU"};
  program.set_version_flag("--version", version());
  program.require_subcommand(1);
  program.failure_message(complaint_of);
  RunOptions run;
  app::ViewOptions view;
  app::InfoOptions info;
  app::BenchOptions bench;
  app::MeshOptions mesh;
  add_run(program, run);
  add_view(program, view);
  add_info(program, info);
  add_bench(program, bench);
  add_mesh(program, mesh);
  add_sweep(program);
  try {
    program.parse(count, arguments);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : static_cast<int>(ErrorKind::command_line);
  }
  if (program.got_subcommand("run")) return app::run(run);
  if (program.got_subcommand("view")) {
    app::view(view);
    return 0;
  }
  if (program.got_subcommand("bench")) return app::bench(bench);
  if (program.got_subcommand("sweep")) app::sweep(program.get_subcommand("sweep")->remaining());
  if (program.got_subcommand("info"))
    app::show_info(info);
  else
    app::show_mesh(mesh);
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  std::signal(SIGXFSZ, SIG_IGN);  // writing beyond a limit on the size of files then fails, as on a full disk
  try {
    const int code = execute(count, arguments);
    std::cout.flush();
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return code;
    return pliant::app::tell_that_output_is_lost(code);
  } catch (...) {
    return pliant::app::tell_failure();
  }
}
