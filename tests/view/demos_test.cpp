// The demos of the start page: they load, and what they promise of contact holds while somebody plays with them.
#include "view/demos.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <random>
#include <utility>

#include "core/stopwatch.hpp"
#include "device/gpu/gpu_device.hpp"
#include "render/frame_renderer.hpp"
#include "simulation/measure.hpp"
#include "simulation/overlap.hpp"
#include "support/evolve.hpp"
#include "support/expect_error.hpp"
#include "support/has.hpp"
#include "support/paths.hpp"
#include "support/scratch.hpp"
#include "view/session.hpp"
#include "view/thrown_ball.hpp"

using namespace pliant;
using namespace pliant::view;

namespace {

std::vector<Demo> shipped_demos() { return find_demos(source_dir() + "/scenes/demos"); }

double from_environment(const char* name, double otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtod(text, nullptr);
}

std::unique_ptr<Device> device_to_play_on() {
  const char* const text = std::getenv("PLIANT_SOAK_DEVICE");
  return text != nullptr && std::string_view(text) == "gpu" ? make_gpu_device(0) : make_cpu_device(0, 32);
}

// Throws, shakes, chooses what to pull, and then does any of these at random.
class Player {
 public:
  Player(Session& session, unsigned seed) : session_(session), random_(seed) {}

  void play() {
    constexpr double first_ones[] = {0, 0.1, 0.2};
    const double what = played_ < std::size(first_ones) ? first_ones[played_] : between(0, 1);
    ++played_;
    if (what < 0.1)
      throw_ball();
    else if (what < 0.15)
      session_.shake();
    else if (what < 0.6)
      pull();
    else
      pull_.reset();
  }
  // The test pulls instead of the session, so that it can measure before and after.
  [[nodiscard]] const std::optional<Pull>& holds() const { return pull_; }
  [[nodiscard]] int thrown() const { return thrown_; }
  [[nodiscard]] int pulled() const { return pulled_; }

 private:
  double between(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  glm::dvec3 somewhere(double size) { return {between(-size, size), between(0.2, size), between(-size, size)}; }

  // One that would touch something at once is not thrown, but another is.
  void throw_ball() {
    pull_.reset();
    for (int k = 0; k < 20; ++k) try {
        const double size = session_.radius();
        const glm::dvec3 from = somewhere(2 * size);
        session_.add(ball_to_throw(session_.model(), size, {from, -from}, session_.scene().simulation.gravity));
        ++thrown_;
        return;
      } catch (const Error& error) {
        CHECK_THAT(error.what(), Catch::Contains("intersect") || Catch::Contains("deep in this ground"));
      }
  }

  void pull() {
    const Model& model = session_.model();
    const auto vertex = static_cast<std::uint32_t>(between(0, model.vertex_count() - 1e-9));
    if (model.body_of(vertex).is_rigid()) return pull();
    pull_ = Pull{.vertex = vertex, .target = somewhere(session_.radius())};
    ++pulled_;
  }

  Session& session_;
  std::optional<Pull> pull_;
  std::mt19937 random_;
  std::size_t played_ = 0;
  int thrown_ = 0, pulled_ = 0;
};

// What is measured of a vibration's energy swings by (omega h / 2)^2 of it where Verlet's method makes steps of h. Steps of
// bodies in contact have at most 0.8 / omega, and the demos' others less.
constexpr double swing_of_verlet = 0.16;

// Follows the energy of a session, less what scripts and pulls put in [J].
class Balance {
 public:
  explicit Balance(Session& session) : session_(session), known_(energy()), put_in_(std::abs(known_)) {}

  // After bodies may have come or gone, which brings energy. Reports count anew then.
  void begin_anew() {
    known_ = energy();
    scripts_ = work_of_scripts();
  }
  void pull(const Pull& by, double seconds) {
    session_.simulation().pull(by, seconds);
    const double before = std::exchange(known_, energy());
    put_in_ += std::abs(known_ - before);
  }
  void look() {
    const double before = std::exchange(known_, energy());
    const double by_scripts = work_of_scripts() - scripts_;
    scripts_ += by_scripts;
    put_in_ += std::abs(by_scripts);
    const double gained = known_ - before - by_scripts;
    gained_ += gained;
    most_gained_ = std::max(most_gained_, gained_ / put_in_);
    rise_ = std::max(rise_ + gained, 0.0);
    highest_rise_ = std::max(highest_rise_, rise_ / put_in_);
  }
  // Since the start, as a part of what had been put in by then.
  [[nodiscard]] double most_gained() const { return most_gained_; }
  // Between any two looks. What damping took before does not hide it.
  [[nodiscard]] double highest_rise() const { return highest_rise_; }
  // With the energy of the start. Signs do not count.
  [[nodiscard]] double put_in() const { return put_in_; }

 private:
  double energy() {
    return measure(session_.model(), session_.simulation().state(), session_.scene().simulation.gravity, pool_).energy();
  }
  double work_of_scripts() { return session_.simulation().report().response.work_of_scripts; }

  Session& session_;
  ThreadPool pool_{2};
  double known_, put_in_, scripts_ = 0, gained_ = 0, most_gained_ = 0, rise_ = 0, highest_rise_ = 0;
};

// What scripted bodies waited since bodies came or went, all together [s].
double waited_by_scripts(Session& session) {
  double waited = 0;
  for (const ScriptReport& script : session.simulation().report().response.scripts) waited += script.waited;
  return waited;
}

TEST_CASE("each demo says what to try, and begins") {
  const std::vector<Demo> demos = shipped_demos();
  CHECK(demos.size() >= 7);
  const auto device = make_cpu_device(0, 32);
  for (const Demo& demo : demos) {
    CAPTURE(demo.scene);
    CHECK_FALSE(demo.title.empty());
    CHECK_THAT(demo.about, Catch::Contains("Try: "));
    Session session(*device, load(demo.scene));
    session.advance_toward(2.0 / 60, 1000);
    CHECK_FALSE(session.breakdown());
    CHECK(session.simulation().intersections().pairs == 0);
  }
}

// Otherwise a ball is clamped when they come together, and both wait for ever.
TEST_CASE("the ball pit's balls fit between its paddle and its walls, also while these are shaken") {
  const auto device = make_cpu_device(0, 32);
  Session session(*device, load(source_dir() + "/scenes/demos/ball_pit.toml"));
  session.shake();
  const Model& model = session.model();
  double ball = 0, reach = 0, wall = 0, far = 0;  // [m]
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const ModelBody& body = model.bodies[b];
    if (!body.is_rigid()) ball = std::max(ball, 2 * body.radius);
    for (std::uint32_t i = body.first_vertex; i < body.first_vertex + body.vertex_count; ++i) {
      const glm::dvec3 place(model.rest_positions[i]);
      if (body.name == "paddle") reach = std::max(reach, std::hypot(place.x, place.z));
      if (body.is_container) wall = std::max(wall, std::abs(place.x));
    }
    if (body.is_container)
      for (const PathKeyDescription& key : session.scene().bodies[b].path) far = std::max(far, std::abs(key.position.x));
  }
  CHECK(ball > 0.3);
  CHECK((reach > 0.5 && far > 0.2));
  CHECK(wall - far - reach > ball);
}

TEST_CASE("the piston presses the ball through the ring") {
  const auto device = make_cpu_device(0, 32);
  Session session(*device, load(source_dir() + "/scenes/demos/narrow_ring.toml"));
  constexpr double piston_is_back = 4.2;  // [s]
  while (session.time() < piston_is_back && !session.breakdown()) session.advance_toward(piston_is_back, 100);
  const Model& model = session.model();
  const std::vector<glm::vec4> positions = session.simulation().world_positions();
  float highest = -1e9f, lowest_of_ring = 1e9f;
  for (std::uint32_t i = 0; i < model.vertex_count(); ++i)
    if (model.body_of(i).name == "ball")
      highest = std::max(highest, positions[i].y);
    else if (model.body_of(i).name == "ring")
      lowest_of_ring = std::min(lowest_of_ring, positions[i].y);
  CHECK(highest < lowest_of_ring);
}

TEST_CASE("a stack falls, and falls again from a restored start by the same bits, on every device", "[gl]") {
  const LoadedScene stack = load(source_dir() + "/scenes/demos/jelly_stack.toml");
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    Session session(*test.device, stack);
    Simulation& simulation = session.simulation();
    const std::string start = simulation.save();
    std::vector<State> ends;
    for (int fall = 0; fall < 2; ++fall) {
      simulation.restore(start);
      simulation.advance(80);
      CHECK_FALSE(simulation.report().breakdown.has_value());
      CHECK(simulation.intersections().pairs == 0);
      ends.push_back(simulation.state());
    }
    CHECK(ends[0].motion == ends[1].motion);
  }
}

TEST_CASE("pictures between steps change no bits of a simulation", "[gl]") {
  if (test::lacks_gl()) return;
  const LoadedScene stack = load(source_dir() + "/scenes/demos/jelly_stack.toml");
  const auto device = make_gpu_device(0);
  std::vector<State> ends;
  for (const bool draws : {false, true}) {
    Session session(*device, stack);
    Simulation& simulation = session.simulation();
    render::FrameRenderer renderer(
        session.model(),
        render::live_options(session.model(), session.start(), stack.description.output, {64, 36}, render::Detail::reduced));
    for (int picture = 0; picture < 4; ++picture) {
      if (draws) renderer.draw(gpu::gl_buffer_of(*device, simulation.position_buffer()), simulation.first_position());
      simulation.advance(20);
    }
    CHECK_FALSE(simulation.report().breakdown.has_value());
    ends.push_back(simulation.state());
  }
  CHECK(ends[0].motion == ends[1].motion);
}

TEST_CASE("a folder without demos is an error, and a bad scene among them is left out") {
  const test::ScratchFolder folder;
  check_says(error_of([&] { return find_demos(folder.path); }), {"has no demos", "name a scene"});
  std::ofstream(folder.path / "bad.toml") << "[[body]]\n";
  std::ofstream(folder.path / "good.toml") << "[[body]]\nmesh = \"icosphere:0\"\n";
  const std::vector<Demo> demos = find_demos(folder.path);
  REQUIRE(demos.size() == 1);
  CHECK(demos[0].title == "good");
}

// PLIANT_DEMO_SECONDS of each demo are simulated, or of those whose names have PLIANT_DEMO in them, on PLIANT_SOAK_DEVICE. Every
// tenth step is looked at in fp64.
TEST_CASE("in each demo bodies stay apart and finite and gain no energy while somebody plays", "[long]") {
  const double seconds = from_environment("PLIANT_DEMO_SECONDS", 0.4);
  const char* const wanted = std::getenv("PLIANT_DEMO");
  const auto device = device_to_play_on();
  for (const Demo& demo : shipped_demos()) {
    if (wanted != nullptr && demo.scene.string().find(wanted) == std::string::npos) continue;
    CAPTURE(demo.scene);
    Session session(*device, load(demo.scene));
    Player player(session, 7);
    Balance balance(session);
    Stopwatch simulating, looking;
    double played_at = 0, told_at = 10, waited = 0, known_wait = 0;
    while (session.time() < seconds && !session.breakdown()) {
      if (session.time() >= played_at) {
        player.play();
        balance.begin_anew();
        known_wait = waited_by_scripts(session);
        played_at += std::min(0.25, seconds / 4);
      }
      const double before = session.time();
      simulating.time([&] { session.advance_toward(before + 10 * session.plan().time_step, 10); });
      looking.time([&] {
        balance.look();
        const double wait_before = std::exchange(known_wait, waited_by_scripts(session));
        waited += known_wait - wait_before;
        if (player.holds()) balance.pull(*player.holds(), session.time() - before);
        const std::vector<glm::dvec3> positions = session.simulation().state().world_positions(session.model());
        CHECK(count_touching_pairs(session.model(), positions) == 0);
      });
      if (session.time() < told_at && session.time() < seconds) continue;
      told_at += 10;
      std::printf(
          "%-20s %6.1f s played in %.1f s and %.1f s of looks, %d balls thrown, %d pulls, %.3g J put in, "
          "of which %.1g gained in all and %.1g in a while, scripts waited %.3g s\n",
          demo.scene.stem().c_str(), session.time(), simulating.seconds(), looking.seconds(), player.thrown(), player.pulled(),
          balance.put_in(), balance.most_gained(), balance.highest_rise(), waited);
      std::fflush(stdout);
    }
    CHECK_FALSE(session.breakdown());
    CHECK(balance.most_gained() <= 1e-6);
    CHECK(balance.highest_rise() <= swing_of_verlet);
    CHECK((player.thrown() > 0 && player.pulled() > 0));
  }
}

}  // namespace
