// The scenes with contact by impulses: each does what mechanics says of it, and no bodies ever intersect.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>

#include "bench/contact/apart.hpp"
#include "model/load_bodies.hpp"
#include "simulation/measure.hpp"
#include "simulation/start_check.hpp"
#include "support/evolve.hpp"
#include "support/shipped_scenes.hpp"

namespace pliant {
namespace {

constexpr double gravity = 9.81;  // of the scenes that have any [m/s^2]

// A body as a whole.
struct Whole {
  double mass = 0;           // [kg]
  glm::dvec3 centre{0.0};    // [m]
  glm::dvec3 velocity{0.0};  // [m/s]
  glm::dvec3 spin{0.0};      // as of a sphere with all mass on its surface [1/s]
};

// A shipped scene on the CPU. Vertices are those of the latest look.
class Play {
 public:
  explicit Play(const std::string& name, int precision = 32, std::span<const std::string> overrides = {})
      : scene_(test::load_shipped_scene(name, overrides)),
        start_(build_model(load_bodies(scene_), scene_.simulation.gravity, scene_.grounds)),
        plan_(plan_time(scene_, start_.model)),
        device_(make_cpu_device(2, precision)),
        simulation_(*device_, start_.model, start_.state, plan_, scene_.collision) {
    expect_apart(simulation_, start_.model, scene_.collision, name);
    look();
  }

  const SceneDescription& scene() const { return scene_; }
  const Model& model() const { return start_.model; }
  const std::vector<glm::dvec3>& positions() const { return positions_; }
  const bench::ApartOracle& oracle() const { return oracle_; }
  const TimePlan& plan() const { return plan_; }
  StepReport report() { return simulation_.report(); }

  void look() {
    const State state = simulation_.state();
    positions_ = state.world_positions(model());
    velocities_ = state.world_velocities(model());
  }
  void step(std::uint64_t steps = 1) {
    simulation_.advance(steps);
    look();
  }
  // Makes a part of a step.
  void part() {
    simulation_.advance_part();
    look();
  }
  // Makes the steps up to this time [s].
  void go_to(double time) { step(steps_to(time)); }
  std::uint64_t steps_to(double time) {
    return static_cast<std::uint64_t>(std::llround((time - report().time) / plan_.time_step));
  }

  // How many pairs of triangles may touch, and vertices stand in other bodies or in grounds.
  std::size_t intersections() const {
    std::size_t count = oracle_.pairs_not_apart(positions_) + oracle_.vertices_inside_others(positions_);
    for (std::size_t i = 0; i < positions_.size(); ++i)
      for (const Ground& ground : model().grounds)
        count += !model().body_of(i).is_rigid() && glm::dot(ground.normal, positions_[i]) <= ground.offset;
    return count;
  }
  // The same, summed over looks at every `stride` steps up to this time [s].
  std::size_t intersections_until(double time, std::uint64_t stride) {
    std::size_t count = intersections();
    for (std::uint64_t left = steps_to(time); left > 0; left -= std::min(left, stride)) {
      step(std::min(left, stride));
      count += intersections();
    }
    return count;
  }

  Whole whole(std::size_t body) const {
    const ModelBody& b = model().bodies[body];
    Whole w{.mass = b.vertex_count * b.vertex_mass};
    for_vertices(b, [&](std::size_t i) {
      w.centre += positions_[i] / static_cast<double>(b.vertex_count);
      w.velocity += velocities_[i] / static_cast<double>(b.vertex_count);
    });
    glm::dvec3 turning(0.0);
    double square = 0;
    for_vertices(b, [&](std::size_t i) {
      const glm::dvec3 arm = positions_[i] - w.centre;
      turning += glm::cross(arm, velocities_[i] - w.velocity);
      square += glm::dot(arm, arm);
    });
    w.spin = 1.5 * turning / square;
    return w;
  }
  glm::dvec3 momentum() const {
    glm::dvec3 sum(0.0);
    for (std::size_t b = 0; b < model().bodies.size(); ++b) sum += whole(b).mass * whole(b).velocity;
    return sum;
  }
  double energy() { return measure(model(), simulation_.state(), scene_.simulation.gravity, pool_).energy(); }
  // The longest way of a vertex from where it was [m].
  double farthest_from(const std::vector<glm::dvec3>& before) const {
    double farthest = 0;
    for (std::size_t i = 0; i < before.size(); ++i) farthest = larger(farthest, glm::length(positions_[i] - before[i]));
    return farthest;
  }
  double lowest(std::size_t body) const {
    double y = 1e300;
    for_vertices(model().bodies[body], [&](std::size_t i) { y = std::min(y, positions_[i].y); });
    return y;
  }
  // Sum of a body's spring forces times heights [J]. Each spring adds its force along y times its extent along y.
  double vertical_virial(std::size_t body) const {
    const ModelBody& b = model().bodies[body];
    double sum = 0;
    for_vertices(b, [&](std::size_t i) {
      for (std::size_t j = b.first_vertex; j < i; ++j) {
        const glm::dvec3 span = positions_[i] - positions_[j];
        const double length = glm::length(span), rest = glm::length(model().rest_position(i) - model().rest_position(j));
        sum -= b.stiffness * (length - rest) * span.y * span.y / length;
      }
    });
    return sum;
  }

 private:
  static void for_vertices(const ModelBody& body, const std::function<void(std::size_t)>& visit) {
    for (std::size_t i = body.first_vertex; i < body.first_vertex + body.vertex_count; ++i) visit(i);
  }

  SceneDescription scene_;
  ModelAndState start_;
  TimePlan plan_;
  bench::ApartOracle oracle_{start_.model};
  std::unique_ptr<Device> device_;
  Simulation simulation_;
  ThreadPool pool_{2};
  std::vector<glm::dvec3> positions_, velocities_;
};

TEST_CASE("a ball comes to rest on the floor where gravity and stiffness say") {
  Play play("ball_on_floor");
  const double duration = play.scene().simulation.duration;
  CHECK(play.intersections_until(duration - 1, 100) == 0);
  const std::vector<glm::dvec3> before = play.positions();
  CHECK(play.intersections_until(duration, 100) == 0);
  const Whole ball = play.whole(0);
  const double lowest = play.lowest(0), weight = ball.mass * gravity, moved = play.farthest_from(before);
  CAPTURE(ball.centre.y, lowest, moved, play.vertical_virial(0));
  CHECK(moved < 1e-3);
  // Heights times forces sum to nothing where every vertex rests: springs, weight, and the floor's force at the lowest vertices.
  CHECK(play.vertical_virial(0) == Approx(weight * (ball.centre.y - lowest)).epsilon(0.01));
  // A sphere's cap of the height d holds N d / 2 r vertices. Springs hold each by N k / 2 against a push inward. So the cap bears
  // K d^2 / 8 r, with K = N^2 k.
  const double total_stiffness = *play.scene().bodies[0].total_stiffness;
  CHECK(1 + lowest - ball.centre.y == Approx(std::sqrt(8 * weight / total_stiffness)).epsilon(0.05));
}

TEST_CASE("of two cubes on a slope one stays, and one slides as Coulomb's law says", "[long]") {
  Play play("slope");
  const double angle = 20 * std::numbers::pi / 180;
  const glm::dvec3 down(std::cos(angle), -std::sin(angle), 0);
  const auto way = [&](std::size_t body) { return glm::dot(play.whole(body).centre, down); };
  std::vector<double> sliding;
  std::size_t intersections = 0;
  for (const double time : {0.6, 1.2, 1.8}) {
    intersections += play.intersections_until(time, 50);
    sliding.push_back(way(2));
  }
  const double acceleration = (sliding[2] - 2 * sliding[1] + sliding[0]) / (0.6 * 0.6);
  CHECK(acceleration == Approx(gravity * (std::sin(angle) - 0.2 * std::cos(angle))).epsilon(0.01));
  intersections += play.intersections_until(3, 50);
  const double before = way(1);
  intersections += play.intersections_until(4, 50);
  const double creep = way(1) - before;  // in a second
  CAPTURE(creep);
  CHECK(std::abs(creep) < 1e-6);
  CHECK(play.whole(2).centre.y < 0.6);  // it lies on the floor
  CHECK(intersections == 0);
}

TEST_CASE("in Newton's cradle the last sphere leaves with nearly all of the speed", "[long]") {
  Play play("newtons_cradle");
  const double speed = play.whole(0).velocity.x;
  CHECK(play.intersections_until(play.scene().simulation.duration, 20) == 0);
  CHECK(play.whole(4).velocity.x >= 0.9 * speed);
  for (std::size_t body = 0; body < 4; ++body) {
    CAPTURE(body);
    CHECK(std::abs(play.whole(body).velocity.x) <= 0.1 * speed);
  }
  CHECK(glm::length(play.momentum() - speed * glm::dvec3(1, 0, 0)) < 1e-7);
}

TEST_CASE("a stack of three cubes stands", "[long]") {
  Play play("stack_of_three");
  const double duration = play.scene().simulation.duration;
  std::size_t intersections = play.intersections_until(0.75 * duration, 100);
  std::vector<glm::dvec3> before;
  for (std::size_t body = 0; body < 3; ++body) before.push_back(play.whole(body).centre);
  double moved[3] = {};  // in radii
  for (std::uint64_t left = play.steps_to(duration); left > 0; left -= std::min<std::uint64_t>(left, 50)) {
    play.step(std::min<std::uint64_t>(left, 50));
    intersections += play.intersections();
    for (std::size_t body = 0; body < 3; ++body)
      moved[body] = larger(moved[body], glm::length(play.whole(body).centre - before[body]) / play.model().bodies[body].radius);
  }
  CHECK(intersections == 0);
  for (std::size_t body = 0; body < 3; ++body) {
    CAPTURE(body, moved[body]);
    CHECK(moved[body] < 1e-3);
    const glm::dvec3 centre = play.whole(body).centre;
    CHECK(std::hypot(centre.x, centre.z) < 0.1);
  }
}

TEST_CASE("a bunny falls on a teapot and does not go into it", "[long]") {
  Play play("bunny_on_teapot");
  const std::vector<glm::dvec3> before = play.positions();
  const double energy = play.energy();
  double most = 0;
  for (const double part : {0.2, 0.4, 0.6, 0.8, 1.0}) {
    CHECK(play.intersections_until(part * play.scene().simulation.duration, 50) == 0);
    most = larger(most, play.energy());
  }
  CHECK(most < energy);
  CHECK(play.report().contact_steps > 100);
  const ModelBody& teapot = play.model().bodies[0];
  CHECK(std::equal(before.begin(), before.begin() + teapot.vertex_count, play.positions().begin()));
}

TEST_CASE("a hundred spheres stay in their box and out of each other, and make no energy", "[long]") {
  Play play("hundred_spheres");
  double before = play.energy();
  for (const double time : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {
    CHECK(play.intersections_until(time, 20) == 0);
    const double energy = play.energy();
    CHECK(energy < before);  // damping and friction take more than 1 J in each tenth of a second
    before = energy;
  }
  CHECK(play.report().contact_steps > 100);
  CHECK(play.report().held_parts == 0);
}

// Fewer of the thousand bodies, in a box that is as full.
const std::string few_of_a_thousand[] = {
    "body.small.count=[5, 2, 5]", "body.middle.count=[3, 2, 3]", "body.large.count=[2, 1, 2]", "body.bunny.count=[1, 1, 1]",
    "ground=[{height=0}, {point=[-26, 0, 0], normal=[1, 0, 0]}, {point=[-9.8, 0, 0], normal=[-1, 0, 0]},"
    "{point=[0, 0, -18], normal=[0, 0, 1]}, {point=[0, 0, -4], normal=[0, 0, -1]}]"};

TEST_CASE("spheres and a bunny that rain into a box stay in it and out of each other, and make no energy") {
  Play play("thousand_bodies", 32, few_of_a_thousand);
  double before = play.energy();
  for (const double time : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {
    CHECK(play.intersections_until(time, 8) == 0);
    const double energy = play.energy();
    CHECK(energy < before);
    before = energy;
  }
  CHECK(play.report().contact_steps > 100);
  CHECK(play.report().held_parts == 0);
}

// With starts that differ a little they sleep after 8.75 to 17.5 s.
TEST_CASE("spheres and a bunny that have rained into a box come to rest and sleep", "[long]") {
  Play play("thousand_bodies", 32, few_of_a_thousand);
  CHECK(play.intersections_until(24, 240) == 0);
  CHECK(play.report().bodies_asleep == play.model().bodies.size());
  CHECK(play.report().held_parts == 0);
}

// Contacts make single vertices of these go at ten times the speed at which a body may sleep. Of eight starts that differ by a
// millimetre all sleep after 6.5 to 7.7 s.
TEST_CASE("bodies of half that size sleep, though their vertices tremble", "[long]") {
  std::vector<std::string> halved(few_of_a_thousand, std::end(few_of_a_thousand) - 1);
  for (const char* change :
       {"body.small.scale=0.45", "body.small.position=[-11.9, 0.8, -8.3]", "body.small.spacing=[1.25, 3, 1.02]",
        "body.middle.scale=0.7", "body.middle.position=[-11.9, 2.3, -7.6]", "body.middle.spacing=[1.7, 3, 1.9]",
        "body.large.scale=1.1", "body.large.position=[-10.5, 7.5, -6.8]", "body.large.spacing=[4.2, 0, 3.4]",
        "body.bunny.scale=0.3", "body.bunny.position=[-10, 10.5, -6]",
        "ground=[{height=0}, {point=[-13, 0, 0], normal=[1, 0, 0]}, {point=[-4.9, 0, 0], normal=[-1, 0, 0]},"
        "{point=[0, 0, -9], normal=[0, 0, 1]}, {point=[0, 0, -2], normal=[0, 0, -1]}]"})
    halved.emplace_back(change);
  Play play("thousand_bodies", 32, halved);
  CHECK(play.intersections_until(play.scene().simulation.duration, 120) == 0);
  CHECK(play.report().bodies_asleep == play.model().bodies.size());
  CHECK(play.report().held_parts == 0);
}

// Fewer of the ten thousand balls. One of the heavy ones still rolls through the fourth of their fields.
const std::string few_of_ten_thousand[] = {"body.dark_blue.count=[8, 1, 11]", "body.light_blue.count=[8, 1, 11]",
                                           "body.green.count=[8, 1, 11]", "body.yellow.count=[8, 1, 11]",
                                           "body.orange.count=[8, 1, 11]"};

TEST_CASE("balls on a floor sleep until a heavy one rolls into them, and those that it misses sleep on") {
  Play play("ten_thousand", 32, few_of_ten_thousand);
  const std::size_t field = 8 * 11, balls = 5 * field;
  const auto moved = [&](std::size_t first, const std::vector<glm::dvec3>& before) {
    const std::size_t begin = play.model().bodies[first].first_vertex, end = play.model().bodies[first + field].first_vertex;
    return !std::equal(before.begin() + begin, before.begin() + end, play.positions().begin() + begin);
  };
  std::size_t intersections = play.intersections_until(1, 20);
  CHECK(play.report().bodies_asleep == balls);
  const std::vector<glm::dvec3> asleep = play.positions();
  double before = play.energy();
  for (const double time : {1.1, 1.2, 1.3, 1.4, 1.5}) {
    intersections += play.intersections_until(time, 12);
    const double energy = play.energy();
    CHECK(energy < before);
    before = energy;
  }
  for (const std::size_t k : {0, 1, 2, 3, 4}) {
    CAPTURE(k);
    CHECK(moved(k * field, asleep) == (k == 3));
  }
  CHECK(play.report().bodies_asleep < balls);
  CHECK(play.report().bodies_asleep >= 4 * field);
  CHECK(intersections == 0);
  CHECK(play.report().held_parts == 0);
}

TEST_CASE("a spinning ball rolls in the end with two fifths of its surface's speed") {
  Play play("spin_to_roll");
  const double surface_speed = -play.whole(0).spin.z;  // of a sphere of 1 m
  const auto slip = [&] { return -play.whole(0).spin.z - play.whole(0).velocity.x; };
  while (slip() > 0.01 * surface_speed && play.report().time < play.scene().simulation.duration) play.step();
  CHECK(slip() <= 0.01 * surface_speed);
  CHECK(play.whole(0).velocity.x == Approx(0.4 * surface_speed).epsilon(0.1));
  CHECK(play.intersections() == 0);
}

TEST_CASE("spheres that meet at twenty edges a step never intersect, and keep momentum", "[long]") {
  Play play("fast_spheres", 64);
  const double edge = 1.1 / 8, closing = play.whole(0).velocity.x - play.whole(1).velocity.x;
  CHECK(closing * play.plan().time_step > 19 * edge);
  double size = 0;
  for (std::size_t body = 0; body < 2; ++body) size += play.whole(body).mass * glm::length(play.whole(body).velocity);
  const glm::dvec3 before = play.momentum();
  const double energy = play.energy();
  double largest = 0, most = 0;
  std::size_t intersections = 0;
  while (play.report().time < play.scene().simulation.duration) {
    const std::vector<glm::dvec3> from = play.positions();
    play.part();
    intersections += play.oracle().pairs_not_apart(bench::between(from, play.positions(), 0.5));
    intersections += play.oracle().pairs_not_apart(play.positions());
    largest = larger(largest, glm::length(play.momentum() - before) / size);
    most = larger(most, play.energy());
  }
  CHECK(most < energy * (1 + 1e-9));
  CAPTURE(largest);
  CHECK(intersections + play.intersections() == 0);
  CHECK(play.report().substeps > 20);
  CHECK(largest < 1e-14);
}

TEST_CASE("bodies of the paper's scenes never intersect if they meet by impulses", "[long]") {
  for (const char* name : {"two_spheres", "soft_and_hard", "sphere_bunny", "bunny_teapot", "three_spheres"}) {
    CAPTURE(name);
    Play play(std::string(name) + "_impulse");
    CHECK(play.intersections_until(0.4 * play.scene().simulation.duration, 20) == 0);  // they have met by then
    CHECK(play.report().contact_steps > 20);
  }
}

}  // namespace
}  // namespace pliant
