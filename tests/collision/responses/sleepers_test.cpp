// When bodies fall asleep and wake: the kernel find_sleepers, by what a step tells it.
#include <catch2/catch.hpp>

#include "physics/contact/cluster.glsl"
#include "physics/contact/debt.glsl"
#include "physics/contact/parts.glsl"
#include "physics/contact/surface.glsl"
#include "support/evolve.hpp"

namespace pliant {
namespace {

constexpr std::uint32_t sleepers = 3;
constexpr double step = 0.125;                        // [s]
constexpr double sleep_speed = 0.5, sleep_way = 0.5;  // [m/s], [m]

// Three bodies of a vertex that have been slow for long. The first two are an island, of which a ground bears the first one.
struct Slumber {
  Slumber() {
    control.time_step = step;
    parts.parts = 10;
    for (physics::Status& status : statuses) {
      status.pressed_by_static = 10;
      status.slow_for = 1;
    }
    for (std::uint32_t b = 0; b < sleepers; ++b) {
      bodies[b].first_vertex = b;
      bodies[b].vertex_count = 1;
    }
    statuses[1].pressed_by_static = 0;
    clusters[1].island = 0;
    clusters[2].island = 2;
  }

  // Which bodies fall asleep in the step.
  std::vector<bool> fall_asleep(Device& device) {
    Arrays arrays(device);
    arrays.set_parameter("body_count", sleepers);
    arrays.set_parameter("vertex_count", sleepers);
    arrays.set_parameter("sleep_speed", sleep_speed);
    arrays.set_parameter("sleep_way", sleep_way);
    arrays.make("body", bodies);
    arrays.make("motion", motion);
    arrays.make("world_position", places);
    auto& noted = arrays.make("slow_place", slow_places);
    arrays.make("control", std::vector{control});
    arrays.make("step_parts", std::vector{parts});
    arrays.make("pressed", pressed);
    arrays.make("debt", debts);
    arrays.make("cluster", clusters);
    arrays.make<physics::ContactList>("contact_list", 1);
    auto& known = arrays.make("status", statuses);
    const Pass pass = make_round_pass(arrays, "find_sleepers", {{"from_half", 0u}});
    device.run({&pass, 1});
    statuses = known.download();
    slow_places = noted.download();
    std::vector<bool> fall;
    for (const physics::Status& status : statuses) fall.push_back(status.falls_asleep != 0);
    return fall;
  }

  // The step moves a body from one place to another, by its centre.
  void go(std::uint32_t b, float from, float to) {
    places[b].x = from;
    places[sleepers + b].x = to;
    motion[physics::displacement_of(b)] = from;
    motion[physics::displacement_of(sleepers + b)] = to;
  }

  physics::Control control{};
  physics::StepParts parts{};
  std::vector<physics::Body> bodies{sleepers};
  std::vector<double> motion = std::vector<double>(2 * sleepers * physics::motion_size);
  std::vector<glm::vec4> places = std::vector<glm::vec4>(2 * sleepers, glm::vec4(0, 0, 0, 1));
  std::vector<glm::vec4> slow_places = std::vector<glm::vec4>(physics::sample_count * sleepers, glm::vec4(0, 0, 0, 1));
  std::vector<physics::Status> statuses{sleepers};
  std::vector<std::uint32_t> pressed{10, 9, 10};
  std::vector<physics::Debt> debts{sleepers};
  std::vector<physics::Cluster> clusters{sleepers};
};

using Bools = std::vector<bool>;

TEST_CASE("an island falls asleep as a whole, if nothing stirs one of its bodies", "[gl]") {
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    CHECK(Slumber().fall_asleep(*test.device) == Bools{true, true, true});
    Slumber stirred, let_go, owes, floats, is_static;
    stirred.clusters[1].is_stirred = 1;
    let_go.pressed[1] = 8;  // two parts of steps ago
    owes.debts[1].energy = 1;
    for (Slumber* restless : {&stirred, &let_go, &owes}) {
      CHECK(restless->fall_asleep(*test.device) == Bools{false, false, true});
      CHECK(restless->statuses[1].slow_for == 0);
    }
    floats.statuses[0].pressed_by_static = 8;
    CHECK(floats.fall_asleep(*test.device) == Bools{false, false, true});
    is_static.statuses[1].activity = physics::immovable;
    CHECK(is_static.fall_asleep(*test.device) == Bools{true, false, true});
  }
}

TEST_CASE("a body sleeps after half a second of steps that stand, and after waking has to be slow for as long again", "[gl]") {
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    Slumber bodies;
    const auto falls = [&] {
      bodies.clusters = Slumber().clusters;  // a step begins
      return bodies.fall_asleep(*test.device);
    };
    for (int round = 0; round < 2; ++round) {
      for (physics::Status& status : bodies.statuses) status.slow_for = round == 0 ? 0.0f : status.slow_for;
      for (int k = 0; k < 3; ++k) {
        CHECK(falls() == Bools{false, false, false});
        bodies.control.time_step = 0;  // it was undone
        CHECK(falls() == Bools{false, false, false});
        bodies.control.time_step = step;
      }
      CHECK(falls() == Bools{true, true, true});
      for (physics::Status& status : bodies.statuses) status.asleep = 1;
      CHECK(falls() == Bools{false, false, false});
      for (physics::Status& status : bodies.statuses) status.disturbed = 1;
      bodies.control.time_step = 0;
      CHECK(falls() == Bools{false, false, false});
      bodies.control.time_step = step;
      for (physics::Status& status : bodies.statuses) {
        CHECK(status.asleep == 0);
        status.disturbed = 0;
      }
    }
  }
}

TEST_CASE("a body that stays where it is sleeps though it trembles, and one that goes on does not", "[gl]") {
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    struct Motion {
      float speed;     // [m/s]
      bool goes_back;  // in every other step
      bool sleeps;
    };
    for (const Motion& m :
         {Motion{0.9f, false, true}, Motion{1.1f, false, false}, Motion{1.9f, true, true}, Motion{2.1f, true, false}}) {
      CAPTURE(m.speed, m.goes_back);
      Slumber bodies;
      for (physics::Status& status : bodies.statuses) status.slow_for = 0;
      float place = 7;
      int slept = 0;
      for (int k = 0; k < 12; ++k) {
        const float next = place + (m.goes_back && k % 2 == 1 ? -1.0f : 1.0f) * m.speed * static_cast<float>(step);
        bodies.clusters = Slumber().clusters;
        bodies.go(2, place, next);
        slept += bodies.fall_asleep(*test.device)[2] ? 1 : 0;
        place = next;
      }
      CHECK((slept > 0) == m.sleeps);
    }
  }
}

// They creep slowly enough in half a second, but in all they go further than a body may that sleeps.
TEST_CASE("bodies that creep fall asleep together, though one began later", "[gl]") {
  constexpr float speed = 0.9f;
  for (const TestDevice& test : all_devices())
    for (const int delay : {0, 1, 2, 3, 7}) {
      CAPTURE(test.name, delay);
      Slumber bodies;
      bodies.statuses[0].slow_for = bodies.statuses[1].slow_for = 0;
      float first = 7, second = 7;
      int slept = -1;
      for (int k = 0; k < 20 && slept < 0; ++k) {
        const float way = speed * static_cast<float>(step);
        bodies.clusters = Slumber().clusters;
        bodies.clusters[1].is_stirred = k < delay ? 1 : 0;
        bodies.go(0, first, first + way);
        bodies.go(1, second, second + way);
        if (bodies.fall_asleep(*test.device)[0]) slept = k;
        first += way;
        second += way;
      }
      CHECK(slept == delay + 3);
    }
}

}  // namespace
}  // namespace pliant
