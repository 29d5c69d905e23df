// Bodies that people pull about for minutes, and that sleep in between. All numbers stay finite, memory stays as it is, and every
// body wakes that should. A run can be made in pieces.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "core/bytes.hpp"
#include "core/stopwatch.hpp"
#include "device/cpu/cpu_device.hpp"
#include "gl/context.hpp"
#include "model/load_bodies.hpp"
#include "output/checkpoint_file.hpp"
#include "simulation/simulation.hpp"
#include "support/evolve.hpp"
#include "support/paths.hpp"
#include "support/resident_memory.hpp"
#include "support/scene_text.hpp"
#include "support/shipped_scenes.hpp"
#include "support/waking.hpp"

namespace pliant {
namespace {

constexpr double time_of_a_pull = 1.0 / 60;  // [s]
constexpr double window_length = 0.1;        // [s]
constexpr std::uint64_t lull_every = 6;      // of so many pauses one is long enough to fall asleep

/// A pause, and a pull after it. A hand takes hold of a vertex and goes straight to a place.
struct Event {
  double pause = 0, length = 0;  // [s]
  std::uint32_t vertex = 0;
  glm::dvec3 place{0.0};  // [m]
  double speed = 0;       // of the hand [m/s]
};

/// The space that a scene's bodies begin in [m].
struct Room {
  glm::dvec3 lower{1e30}, upper{-1e30};
};

Room room_of(const ModelAndState& start) {
  Room room;
  for (const glm::dvec3& p : start.state.world_positions(start.model)) {
    room.lower = glm::min(room.lower, p);
    room.upper = glm::max(room.upper, p);
  }
  return room;
}

/// Events are numbered from 0. Each is known by its number alone.
Event event_of(std::uint64_t number, const Model& model, const Room& room) {
  std::seed_seq seed{std::uint32_t{20}, static_cast<std::uint32_t>(number)};
  std::mt19937 random(seed);
  const auto between = [&](double least, double most) { return std::uniform_real_distribution<double>(least, most)(random); };
  const bool is_lull = number % lull_every == lull_every - 1;
  Event event{.pause = is_lull ? between(8, 16) : between(0.5, 2), .length = between(window_length, 0.5)};
  std::uniform_int_distribution<std::size_t> any_body(0, model.bodies.size() - 1);
  const ModelBody* body = &model.bodies[any_body(random)];
  while (body->is_rigid()) body = &model.bodies[any_body(random)];
  event.vertex = body->first_vertex + std::uniform_int_distribution<std::uint32_t>(0, body->vertex_count - 1)(random);
  const glm::dvec3 part{between(0, 1), between(0, 1), between(0, 1)};  // braces say in which order
  event.place = glm::mix(room.lower, room.upper, part);
  event.speed = between(1, 15);
  return event;
}

/// What a run has done since its start. A checkpoint holds it as bytes.
struct SoakProgress {
  std::uint64_t events = 0, windows = 0;
  std::uint64_t sleepers = 0, woken = 0;  // sums over windows: of bodies that slept through, and of those that woke
  std::uint64_t most_woken = 0;           // in one window
  std::uint64_t breaches = 0;
  std::uint64_t breaches_if_none_woke = 0;      // what the laws would say then
  double farthest = 0, farthest_by_a_pull = 0;  // that sleepers would go without sleep [m]
  bool operator==(const SoakProgress&) const = default;
};

class Soak {
 public:
  /// `device` must outlive it.
  Soak(Device& device, const SceneDescription& scene)
      : device_(device),
        start_(build_model(load_bodies(scene), scene.simulation.gravity, scene.grounds)),
        plan_(plan_time(scene, start_.model)),
        room_(room_of(start_)),
        stillness_(test::stillness_of(start_.model, glm::length(scene.simulation.gravity))),
        simulation_(device, start_.model, start_.state, plan_, scene.collision),
        awake_(device, start_.model, start_.state, plan_, scene.collision) {
    REQUIRE(plan_.sleep);
    REQUIRE_FALSE(plan_.tolerance);
  }

  /// Makes whole pauses and pulls until the simulated time is `time` [s]. It ends where a run with other ends would pass through.
  void run_to(double time) {
    if (resident_.empty()) note_first_memory();
    while (simulation_.report().time < time && !simulation_.report().breakdown) make_event();
  }
  [[nodiscard]] std::string save() {
    ByteWriter saved;
    saved(progress_, simulation_.save());
    return saved.take();
  }
  void restore(std::string_view saved) {
    std::string of_simulation;
    ByteReader from(saved);
    from(progress_, of_simulation);
    simulation_.restore(of_simulation);
  }
  [[nodiscard]] Simulation& simulation() { return simulation_; }
  [[nodiscard]] const SoakProgress& progress() const { return progress_; }
  [[nodiscard]] const std::vector<std::string>& said() const { return said_; }
  /// Hands over what save() would have returned before the first window in which a law is broken.
  void keep_before_breach(std::function<void(const std::string&)> keep) { keep_before_breach_ = std::move(keep); }
  /// Returns how much more memory the second half of the piece needed than the first half, which begins before the first event
  /// [MiB].
  [[nodiscard]] double growth() const {
    const auto middle = resident_.begin() + static_cast<std::ptrdiff_t>(resident_.size() / 2);
    return *std::max_element(middle, resident_.end()) - *std::max_element(resident_.begin(), middle);
  }
  [[nodiscard]] std::string table();

 private:
  void make_event();
  test::Window see_window(const Event* event);
  void see_pause(double length) {
    rest(length / 2);
    judge(see_window(nullptr));
    rest(length / 2);
  }
  void judge(const test::Window& window);
  void judge_health();
  void note_memory();
  void note_first_memory();
  [[nodiscard]] std::size_t play_in_memory() const;
  void say(const std::string& what) {
    said_.push_back(fmt::format("event {}, {:.3f} s: {}", progress_.events, simulation_.report().time, what));
  }
  [[nodiscard]] std::uint64_t steps_in(double time) const {
    return static_cast<std::uint64_t>(std::ceil(time / plan_.time_step));
  }
  void rest(double length) {
    stepping_.time([&] {
      simulation_.advance(steps_in(length));
      device_.finish();
    });
  }
  void drag(Simulation& simulation, const Event* event, std::uint64_t first_step, std::uint64_t steps);

  Device& device_;
  ModelAndState start_;
  TimePlan plan_;
  Room room_;
  test::Stillness stillness_;
  Simulation simulation_, awake_;  // the second one makes windows in which nobody sleeps
  glm::dvec3 hold_{0.0};           // where the vertex was that is pulled [m]
  SoakProgress progress_;
  std::vector<std::string> said_;
  std::string before_window_;  // as save() has it
  std::function<void(const std::string&)> keep_before_breach_;
  std::vector<double> resident_;        // before the first event of this piece, and at the end of each [MiB]
  std::vector<std::size_t> allocated_;  // then, on the device [bytes]
  Stopwatch stepping_, all_;
};

// Makes some of an event's steps. Without an event they are a pause's.
void Soak::drag(Simulation& simulation, const Event* event, std::uint64_t first_step, std::uint64_t steps) {
  const std::uint64_t steps_of_pull =
      std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::lround(time_of_a_pull / plan_.time_step)));
  for (std::uint64_t done = 0; done < steps;) {
    const std::uint64_t batch = std::min(steps_of_pull, steps - done);
    if (event != nullptr) {
      const glm::dvec3 way = event->place - hold_;
      const double gone = event->speed * static_cast<double>(first_step + done + batch) * plan_.time_step;
      const double part = std::min(1.0, gone / std::max(glm::length(way), 1e-9));
      simulation.pull({.vertex = event->vertex, .target = hold_ + part * way}, static_cast<double>(batch) * plan_.time_step);
    }
    simulation.advance(batch);
    done += batch;
  }
}

test::Window Soak::see_window(const Event* event) {
  const std::uint64_t steps = steps_in(window_length);
  const auto make = [&](Simulation& simulation, const Event* by) {
    drag(simulation, by, 0, steps - 1);
    std::vector<glm::vec4> last_start = simulation.world_positions();
    drag(simulation, by, steps - 1, 1);
    return last_start;
  };
  before_window_ = save();
  const std::string saved = simulation_.save(), with_all_awake = test::with_all_awake(saved, start_.model);
  test::Window window;
  window.before = test::saved_statuses(saved, start_.model);
  window.start = simulation_.world_positions();
  if (event != nullptr) hold_ = glm::dvec3(glm::vec3(window.start[event->vertex]));
  if (event != nullptr) window.pulled = {start_.model.body_index(event->vertex)};
  const auto make_awake = [&](const Event* by) {
    awake_.restore(with_all_awake);
    make(awake_, by);
    return awake_.world_positions();
  };
  window.last_start = stepping_.time([&] { return make(simulation_, event); });
  window.impulses = simulation_.contact_impulses();
  window.after = test::saved_statuses(simulation_.save(), start_.model);
  window.awake = make_awake(event);
  if (event != nullptr) window.awake_and_let_be = make_awake(nullptr);
  return window;
}

void Soak::judge(const test::Window& window) {
  const std::vector<std::string> breaches = test::breaches(window, start_.model, stillness_);
  for (const std::string& breach : breaches) say(breach);
  if (!breaches.empty() && keep_before_breach_) {
    keep_before_breach_(before_window_);
    keep_before_breach_ = {};
  }
  test::Window none_woke = window;
  none_woke.after = window.before;
  ++progress_.windows;
  progress_.sleepers += window.sleepers();
  progress_.woken += window.woken();
  progress_.most_woken = std::max(progress_.most_woken, window.woken());
  const test::Stillness most = test::farthest_of_sleepers(window, start_.model);
  progress_.farthest = std::max(progress_.farthest, most.in_half_a_second);
  progress_.farthest_by_a_pull = std::max(progress_.farthest_by_a_pull, most.by_a_pull);
  progress_.breaches += breaches.size();
  progress_.breaches_if_none_woke += test::breaches(none_woke, start_.model, stillness_).size();
}

// A grip has as many vertices as it reaches. The CPU has room for the bodies whose springs it summed last.
std::size_t Soak::play_in_memory() const {
  std::size_t largest_grip = 0;
  std::vector<std::uint32_t> vertex_counts;
  for (const ModelBody& body : start_.model.bodies) {
    largest_grip = std::max(largest_grip, body.vertex_count * sizeof(physics::GripVertex));
    if (!body.is_rigid()) vertex_counts.push_back(body.vertex_count);
  }
  const bool is_cpu = device_.info().kind == DeviceKind::cpu;
  return 2 * largest_grip + (is_cpu ? cpu::spring_scratch_bytes(vertex_counts, device_.precision()) : 0);
}

void Soak::judge_health() {
  if (simulation_.report().breakdown) say("a vertex is not finite");
  if (!std::ranges::all_of(simulation_.state().motion, [](double number) { return std::isfinite(number); }))
    say("a number is not finite");
  note_memory();
  if (allocated_.back() > allocated_.front() + play_in_memory())
    say(fmt::format("the device holds {} bytes, and held {}", allocated_.back(), allocated_.front()));
}

void Soak::note_memory() {
  resident_.push_back(test::trimmed_resident_memory());
  allocated_.push_back(device_.allocated_bytes());
}

// Makes a window first and takes it back, because memory counts as resident only once it has been used.
void Soak::note_first_memory() {
  const std::string saved = save();
  (void)see_window(nullptr);
  stepping_ = {};
  restore(saved);
  note_memory();
}

void Soak::make_event() {
  all_.time([&] {
    const Event event = event_of(progress_.events, start_.model, room_);
    see_pause(event.pause);
    judge(see_window(&event));
    const std::uint64_t first = steps_in(window_length), steps = std::max(steps_in(event.length), first);
    stepping_.time([&] {
      drag(simulation_, &event, first, steps - first);
      device_.finish();
    });
    judge_health();
    ++progress_.events;
  });
}

std::string Soak::table() {
  const StepReport report = simulation_.report();
  const auto row = [](const char* what, const std::string& value) { return fmt::format("{:<42} {:>14}\n", what, value); };
  const double steps = std::max(1.0, static_cast<double>(report.steps));
  return "\n" + row("simulated time [s]", fmt::format("{:.3f}", report.time)) + row("steps", fmt::to_string(report.steps)) +
         row("parts of steps beyond one each", fmt::to_string(report.substeps)) + row("pulls", fmt::to_string(progress_.events)) +
         row("windows looked at", fmt::to_string(progress_.windows)) + row("bodies", fmt::to_string(start_.model.bodies.size())) +
         row("bodies asleep now", fmt::to_string(report.bodies_asleep)) +
         row("bodies asleep, mean", fmt::format("{:.1f}", static_cast<double>(report.steps_asleep) / steps)) +
         row("bodies woken in windows", fmt::to_string(progress_.woken)) +
         row("most of them at once", fmt::to_string(progress_.most_woken)) +
         row("bodies that slept through windows", fmt::to_string(progress_.sleepers)) +
         row("they would go at most, of what may rest", fmt::format("{:.4f}", progress_.farthest / stillness_.in_half_a_second)) +
         row("and by a pull, of what may be", fmt::format("{:.4f}", progress_.farthest_by_a_pull / stillness_.by_a_pull)) +
         row("breaches", fmt::to_string(progress_.breaches)) +
         row("breaches if none had woken", fmt::to_string(progress_.breaches_if_none_woke)) +
         row("vertices cut short", fmt::to_string(report.reverted_vertices)) +
         row("parts of steps that were held", fmt::to_string(report.held_parts)) +
         row("contacts that did not settle", fmt::to_string(report.unsettled_contacts)) +
         row("energy that sleep took [J]", fmt::format("{:.4g}", report.energy_slept)) +
         row("device memory [bytes]", fmt::to_string(device_.allocated_bytes())) +
         row("resident memory [MiB]", fmt::format("{:.1f}", test::trimmed_resident_memory())) +
         row("its growth over half of the piece [MiB]", fmt::format("{:.1f}", growth())) +
         row("this piece: wall time of its steps [s]", fmt::format("{:.1f}", stepping_.seconds())) +
         row("this piece: wall time with all looks [s]", fmt::format("{:.1f}", all_.seconds()));
}

void check_said(const Soak& soak) {
  for (const std::string& what : soak.said()) UNSCOPED_INFO(what);
  CHECK(soak.said().empty());
}

const std::string balls_apart = R"(
[simulation]
integrator = "verlet"
time_step = 0.005
duration = 1
damping_law = "constant"
gravity = [0, -9.81, 0]
sleep = true
[collision]
elasticity = 0
friction = 0.5
[[ground]]
height = 0
[[ground]]
point = [-5, 0, 0]
normal = [1, 0, 0]
[[ground]]
point = [5, 0, 0]
normal = [-1, 0, 0]
[[ground]]
point = [0, 0, -5]
normal = [0, 0, 1]
[[ground]]
point = [0, 0, 5]
normal = [0, 0, -1]
[[body]]
mesh = "icosphere:1"
count = [6, 1, 6]
spacing = [1.5, 1, 1.5]
position = [-3.75, 0.6, -3.75]
scale = 0.4
total_stiffness = 4000
total_mass = 1
damping = 0.05
[[body]]
mesh = "icosphere:1"
count = [2, 2, 2]
spacing = [1.5, 1, 1.5]
position = [-0.9, 1.6, -0.6]
scale = 0.4
total_stiffness = 4000
total_mass = 1
damping = 0.05
)";

TEST_CASE("bodies that are pulled about wake when they should, and pieces of a run give the bits of the whole", "[long]") {
  const SceneDescription scene = load_text(balls_apart);
  const auto device = make_cpu_device(2, 32);
  Soak whole(*device, scene);
  whole.run_to(40);
  check_said(whole);
  CHECK(whole.progress().woken > 20);
  CHECK(whole.progress().sleepers > 100);
  CHECK(whole.progress().breaches_if_none_woke > whole.progress().woken);
  CHECK(whole.simulation().intersections().pairs == 0);

  std::string saved;
  for (const double end : {7.0, 25.0, 40.0}) {
    Soak piece(*device, scene);
    if (!saved.empty()) piece.restore(saved);
    piece.run_to(end);
    saved = piece.save();
    check_said(piece);
    if (end < 40) continue;
    CHECK(piece.progress() == whole.progress());
    CHECK((piece.simulation().state().motion == whole.simulation().state().motion));
    CHECK(piece.simulation().report().bodies_asleep == whole.simulation().report().bodies_asleep);
  }
}

/// What a checkpoint of a run of minutes holds. Another scene or device would give other bits.
struct SoakCheckpoint {
  std::string scene, device, soak;
};

std::string read_piece(const std::filesystem::path& file, const std::string& scene, const Device& device) {
  SoakCheckpoint before;
  const std::string bytes = read_checkpoint(file);
  ByteReader from(bytes);
  from(before.scene, before.device, before.soak);
  REQUIRE(before.scene == scene);
  REQUIRE(before.device == device.info().name);
  return before.soak;
}

void write_piece(const std::filesystem::path& file, const std::string& scene, const Device& device, const std::string& soak) {
  ByteWriter bytes;
  bytes(scene, device.info().name, soak);
  write_checkpoint(file, bytes.take());
}

SceneDescription soak_scene(const std::string& name) {
  const std::vector<std::string> overrides{"simulation.sleep=true"};
  SceneDescription scene = test::load_shipped_scene(name, overrides);
  return from_environment("PLIANT_SOAK_THINNED", "").empty() ? scene : test::thinned(std::move(scene));
}

std::unique_ptr<Device> soak_device() {
  const auto adapters = gl::list_adapters();
  const bool has_gpu = !adapters.empty() && !adapters.front().is_software;
  const std::string wish = from_environment("PLIANT_SOAK_DEVICE", has_gpu ? "gpu" : "cpu");
  return wish == "gpu" ? make_gpu_device(0) : make_cpu_device(0, 32);
}

// These variables say what is run:
// - PLIANT_SOAK_SCENE: a scene of scenes/, thousand_bodies unless given
// - PLIANT_SOAK_THINNED: if it is set, only 128 bodies of the scene are kept
// - PLIANT_SOAK_DEVICE: gpu or cpu. Without it that is the GPU, if there is one
// - PLIANT_SOAK_MINUTES: of simulated time in this piece, 10 unless given. The piece ends with the pull that is then at hand
// - PLIANT_SOAK_CHECKPOINT: a file. The piece goes on from it, if it is there, and replaces it at its end. If a law was broken,
//   a file beside it has the state before that, too.
TEST_CASE("a thousand bodies that are pulled about for ten minutes stay finite, need no more memory and wake when they should",
          "[.soak][gl]") {
  const std::string name = from_environment("PLIANT_SOAK_SCENE", "thousand_bodies");
  const double minutes = std::stod(from_environment("PLIANT_SOAK_MINUTES", "10"));
  const std::filesystem::path checkpoint = from_environment("PLIANT_SOAK_CHECKPOINT", "");
  const auto device = soak_device();
  Soak soak(*device, soak_scene(name));
  if (std::filesystem::exists(checkpoint)) soak.restore(read_piece(checkpoint, name, *device));
  if (!checkpoint.empty())
    soak.keep_before_breach(
        [&](const std::string& saved) { write_piece(checkpoint.string() + ".before", name, *device, saved); });
  soak.run_to(soak.simulation().report().time + 60 * minutes);
  if (!checkpoint.empty()) write_piece(checkpoint, name, *device, soak.save());
  WARN(name << " on " << device->info().name << soak.table());
  check_said(soak);
  CHECK(soak.growth() < 16);
  CHECK(soak.simulation().intersections().pairs == 0);
}

}  // namespace
}  // namespace pliant
