// Contact by impulses at rest and at its extremes, and what it does to energy.
#include "bench/contact/rest.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "bench/contact/meeting.hpp"
#include "bench/contact/witness.hpp"
#include "simulation/measure.hpp"
#include "simulation/start_check.hpp"
#include "support/evolve.hpp"

namespace pliant {
namespace {

const CollisionDescription without_bounce = {.response = {"impulse"}, .elasticity = 0};

BodySetup resting(const char* mesh, const char* name, double radius = 1, double mass = 1, double stiffness = 1000) {
  BodySetup setup = body_of_mesh(generate_mesh(mesh));
  setup.description.name = name;
  setup.description.scale = radius;
  setup.description.total_mass = mass;
  setup.description.total_stiffness = stiffness;
  setup.description.rotation = {10, 20, 0};
  return setup;
}

BodySetup standing(const char* mesh, const char* name) {
  BodySetup setup = body_of_mesh(generate_mesh(mesh));
  setup.description.name = name;
  setup.description.kind = BodyKind::immovable;
  return setup;
}

// With damping that takes a tenth of the stiffest frequency.
ModelAndState damped(std::vector<BodySetup> setups) {
  for (BodySetup& setup : setups) {
    if (setup.description.kind == BodyKind::immovable) continue;
    const ModelBody body = built(setup).model.bodies.front();
    setup.description.damping = 0.1 * stiffest_frequency(body) * body.vertex_mass;
  }
  return build_model(setups, {0, -9.81, 0});
}

// A ball that wedges itself between four spheres. Its contacts have many normals, and friction holds it up.
bench::RestingPlace wedged_ball() {
  std::vector<bench::RestingPlace> places = bench::resting_places();
  return *std::ranges::find(places, "ball between posts", &bench::RestingPlace::name);
}

// Returns the longest step while contacts press the body, with what the device's float rounds [s].
double longest_pressed(const ModelBody& body, DampingLaw law) {
  const double rate = stiffest_frequency(body) + largest_damping_rate(body, law) / 2;
  return physics::longest_pressed_rate / rate * (1 + 1e-6);
}

double time_step_of(const Model& model) { return 0.3 / stiffest_frequency(model.bodies.back()); }

TEST_CASE("a ball that is wedged between static meshes rests") {
  for (const int precision : {64, 32}) {
    CAPTURE(precision);
    const bench::RestSeen rest =
        bench::watch_rest(*make_cpu_device(1, precision), wedged_ball(), {.settling = 2000, .watched = 300});
    CHECK(rest.contacts > 20);
    CHECK(rest.inside == 0);
    CHECK(rest.most_a_step < (precision == 64 ? 1e-9 : 1e-6));
    CHECK(rest.drift < (precision == 64 ? 1e-8 : 1e-5));
    CHECK(rest.cut_vertices == 0);
  }
}

TEST_CASE("a small ball rests on a slab with edges of ten metres, far from the origin, too") {
  for (const double far : {0.0, 1e4}) {
    CAPTURE(far);
    std::vector<BodySetup> setups = {standing("cube:1", "slab"), resting("icosphere:2", "ball", 0.05, 0.01, 100)};
    setups[0].description.scale = 10;
    for (BodySetup& setup : setups) setup.description.position = {far, far, far};
    setups[1].description.position += glm::dvec3(0.1, 5.052, 0.2);
    const ModelAndState start = damped(std::move(setups));
    for (const int precision : {64, 32}) {
      CAPTURE(precision);
      CHECK(told_rounding(start.model, start.state, without_bounce, precision).empty());
      const bench::RestSeen rest =
          bench::watch_rest(*make_cpu_device(1, precision), {.name = "slab", .start = start}, {.settling = 1500, .watched = 200});
      CHECK(rest.contacts > 0);
      CHECK(rest.inside == 0);
      CHECK(rest.most_a_step < (precision == 64 ? 1e-8 : 1e-6));
      CHECK(rest.cut_vertices == 0);
    }
  }
}

// What lies in contact bounds steps, and no whole number of such steps makes a picture.
TEST_CASE("a ball rests in steps of a tolerance, which are equal from one picture to the next") {
  BodySetup ball = resting("icosphere:1", "ball", 0.5, 1, 4000);
  ball.description.position = {0, 0.54, 0};
  ball.description.rotation = {0, 0, 0};  // so that it does not rock
  ball.description.damping = 5.0 / 42;    // a rate of 5 / s
  const glm::dvec3 gravity(0, -9.81, 0);
  const GroundDescription ground;
  const ModelAndState start = build_model({&ball, 1}, gravity, {&ground, 1});
  for (const double picture : {1.0 / 60, 1.0 / 5}) {
    CAPTURE(picture);
    const TimePlan plan = plan_of(Adaptive{.integrator = "dop853", .tolerance = 1e-4, .law = DampingLaw::internal}, start.model);
    const auto device = make_cpu_device(1, 64);
    Simulation simulation(*device, start.model, start.state, plan, without_bounce);
    double end = 0;
    const auto make_picture = [&] { simulation.advance_to(end += picture); };
    while (end < 40) make_picture();
    const std::vector<glm::dvec3> before = simulation.state().world_positions(start.model);
    for (int k = 0; k < 5; ++k) {
      std::vector<double> steps;
      end += picture;
      for (double time = simulation.report().time; time < end; time += steps.back())
        steps.push_back(simulation.advance_toward(end, 1).time - time);
      const auto [shortest, longest] = std::ranges::minmax(steps);
      CHECK(longest < shortest * (1 + 1e-9));
      CHECK(longest <= longest_pressed(start.model.bodies[0], DampingLaw::internal));
    }
    CHECK(simulation.report().reverted_vertices == 0);
    const std::vector<glm::dvec3> after = simulation.state().world_positions(start.model);
    for (std::size_t i = 0; i < before.size(); ++i) CHECK(glm::length(after[i] - before[i]) < 1e-4);
  }
}

TEST_CASE("a run names the body whose contacts are lost in rounding") {
  std::vector<BodySetup> setups = {standing("cube:1", "slab"), resting("icosphere:2", "speck", 0.001, 1e-6, 0.1),
                                   resting("icosphere:2", "ball")};
  setups[0].description.scale = 10;
  setups[2].description.position = {0, 9, 0};
  ModelAndState start = damped(setups);
  const std::vector<std::string> told = told_rounding(start.model, start.state, without_bounce, 32);
  REQUIRE(told.size() == 1);
  CHECK(told[0].find("\"speck\" with \"slab\"") != std::string::npos);
  CHECK(told[0].find("--precision 64") != std::string::npos);
  CHECK(told_rounding(start.model, start.state, without_bounce, 64).empty());
  start.state.poses[1].origin[0] = 1e10;
  CHECK(told_rounding(start.model, start.state, without_bounce, 64).at(0).find("nearer to the origin") != std::string::npos);
}

TEST_CASE("a ball on the ground gains no energy where damping bounds steps") {
  BodySetup ball = resting("icosphere:1", "ball");
  ball.description.position = {0, 1.06, 0};
  ball.description.rotation = {0, 0, 0};
  ball.description.damping = 1000.0 / 42;  // a rate of 1000 / s, where omega is 31.6 / s
  const glm::dvec3 gravity(0, -9.81, 0);
  const GroundDescription ground;
  const ModelAndState start = build_model({&ball, 1}, gravity, {&ground, 1});
  for (const char* integrator : {"rk4", "cv8", "dop853", "vern8", "verner78_8"})
    for (const DampingLaw law : {DampingLaw::constant, DampingLaw::internal}) {
      CAPTURE(integrator, static_cast<int>(law));
      const double time_step = 0.98 * step_bound(find_integrator(integrator), start.model.bodies[0], law);
      const auto device = make_cpu_device(1, 64);
      Simulation simulation(*device, start.model, start.state, plan_of(Method{integrator, time_step, law}), without_bounce);
      simulation.advance(static_cast<std::uint64_t>(1 / time_step));
      ThreadPool pool(1);
      const auto energy = [&] { return measure(start.model, simulation.state(), gravity, pool).energy(); };
      double gained = 0;
      for (double before = energy(); simulation.report().time < 2;) {
        simulation.advance(10);
        REQUIRE_FALSE(simulation.report().breakdown);
        gained += std::max(energy() - before, 0.0);
        before = energy();
      }
      CHECK(gained < 1e-4);  // [J]. Without a bound of contact some of them blew up
    }
}

TEST_CASE("a strongly damped cube gains no energy on the ground in steps of a tolerance") {
  BodySetup cube = resting("cube:2", "cube");
  cube.description.position = {0, 0.56, 0};
  cube.description.rotation = {0, 0, 0};
  cube.description.damping = 1260.0 / 26;  // 40 omega
  const glm::dvec3 gravity(0, -9.81, 0);
  const GroundDescription ground;
  const ModelAndState start = build_model({&cube, 1}, gravity, {&ground, 1});
  for (const double tolerance : {0.1, 1e-3}) {
    CAPTURE(tolerance);
    const auto device = make_cpu_device(1, 64);
    const TimePlan plan =
        plan_of(Adaptive{.integrator = "dop853", .tolerance = tolerance, .law = DampingLaw::internal}, start.model);
    Simulation simulation(*device, start.model, start.state, plan, without_bounce);
    ThreadPool pool(1);
    const auto energy = [&] { return measure(start.model, simulation.state(), gravity, pool).energy(); };
    REQUIRE_FALSE(simulation.advance_to(2).breakdown);
    double longest = 0, gained = 0, before = energy();
    for (double time = 2; time < 3;) {
      const double next = simulation.advance_toward(3, 1).time;
      REQUIRE(next > time);
      longest = std::max(longest, next - time);
      time = next;
      gained += std::max(energy() - before, 0.0);
      before = energy();
    }
    CHECK(longest <= longest_pressed(start.model.bodies[0], DampingLaw::internal));
    CHECK(gained < 1e-4);  // [J]
  }
}

// Four balls of 1 kg and 8000 N/m that fall into a box of five grounds.
ModelAndState pile(double damping_rate) {
  std::mt19937 random(4);
  const auto between = [&](double least, double most) {
    return least + (most - least) * static_cast<double>(random()) / 4294967296.0;
  };
  std::vector<BodySetup> setups;
  for (int i = 0; i < 4; ++i) {
    BodySetup& ball =
        setups.emplace_back(resting(random() % 3 == 0 ? "icosphere:1" : "icosphere:2", "ball", between(0.4, 0.6), 1, 8000));
    ball.description.position = {between(-0.4, 0.4), 0.8 + 1.3 * i, between(-0.4, 0.4)};
    ball.description.rotation = {between(0, 360), between(0, 360), between(0, 360)};
    ball.description.damping = damping_rate * built(ball).model.bodies.front().vertex_mass;
  }
  std::vector<GroundDescription> box(5);
  const glm::dvec3 inward[] = {{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < 4; ++i) {
    box[i].point = -1.1 * inward[i];
    box[i].normal = inward[i];
  }
  return build_model(setups, {0, -9.81, 0}, box);
}

TEST_CASE("hardly a motion is cut short in a pile of strongly damped balls") {
  const double omega = std::sqrt(8000.0);
  for (const double rate : {omega, 2 * omega})
    for (const char* integrator : {"cv8", "verlet"}) {
      CAPTURE(rate / omega, integrator);
      const ModelAndState start = pile(rate);
      const auto device = make_cpu_device(1, 32);
      const double bound = step_bound(find_integrator(integrator), start.model.bodies[0], DampingLaw::internal);
      const double time_step = std::min(1.0 / 60, 0.9 * bound);
      Simulation simulation(*device, start.model, start.state, plan_of(Method{integrator, time_step, DampingLaw::internal}),
                            {.response = {"impulse"}, .elasticity = 0.5});
      simulation.advance(static_cast<std::uint64_t>(4 / time_step));
      CHECK(simulation.report().reverted_vertices < 50);
    }
}

TEST_CASE("a stiff cube comes to rest in steps near their bound") {
  BodySetup cube = resting("cube:1", "cube", 1, 1, 1e5);
  cube.description.rotation = {0, 0, 0};
  cube.description.position = {0, 0.56, 0};
  cube.description.damping = 0.02;
  const glm::dvec3 gravity(0, -9.81, 0);
  const GroundDescription ground;
  const ModelAndState start = build_model({&cube, 1}, gravity, {&ground, 1});
  const double time_step = 0.79 / stiffest_frequency(start.model.bodies[0]);
  const auto device = make_cpu_device(1, 64);
  for (const char* integrator : {"cv8", "rk4", "verlet"}) {
    CAPTURE(integrator);
    Simulation settling(*device, start.model, start.state, plan_of(Method{integrator, time_step, DampingLaw::constant}),
                        without_bounce);
    settling.advance(static_cast<std::uint64_t>(12 / time_step));
    ThreadPool pool(1);
    double most = 0;
    for (int k = 0; k < 100; ++k) {
      settling.advance(1);
      most = std::max(most, measure(start.model, settling.state(), gravity, pool).kinetic);
    }
    const double swing = glm::length(gravity) * time_step / 2;  // that a body at rest shows in each step [m/s]
    CHECK(most < 10 * swing * swing / 2);
  }
}

// In steps of 0.59 / omega. Verlet's method lets it swing on (docs/contact.md).
TEST_CASE("a stiff column that is damped swings less and less") {
  std::vector<BodySetup> setups;
  for (int i = 0; i < 4; ++i) {
    setups.push_back(resting("cube:1", "cube", 1, 1, 1e5));
    setups.back().description.rotation = {0, 0, 0};
    setups.back().description.position = {0, 0.5575 + 1.0575 * i, 0};  // 0.6 mm further apart than their gap
    setups.back().description.damping = 1;
  }
  const GroundDescription ground;
  const ModelAndState start = build_model(setups, {0, -9.81, 0}, {&ground, 1});
  for (const char* integrator : {"cv8", "rk4"}) {
    CAPTURE(integrator);
    const auto device = make_cpu_device(1, 64);
    Simulation settling(*device, start.model, start.state, plan_of(Method{integrator, 1.0 / 540, DampingLaw::internal}),
                        {.response = {"impulse"}, .elasticity = 0.5});
    const std::uint32_t top = start.model.bodies.back().first_vertex;
    std::vector<double> swings;
    for (int second = 0; second < 16; ++second) {
      double lowest = 1e9, highest = 0;
      for (int k = 0; k < 180; ++k) {
        settling.advance(3);
        const double height = settling.state().world_positions(start.model)[top].y;
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
      }
      swings.push_back(highest - lowest);
    }
    CHECK(swings[7] < 0.8 * swings[3]);
    CHECK(swings[11] < 0.8 * swings[7]);
    CHECK(swings[15] < 0.8 * swings[11]);
  }
}

TEST_CASE("what contacts at rest take up from the last step does not depend on threads") {
  const ModelAndState start = wedged_ball().start;
  const TimePlan plan = plan_of(Method{"verlet", time_step_of(start.model), DampingLaw::constant});
  std::vector<std::string> saved;
  for (const unsigned threads : {1u, 3u}) {
    const auto device = make_cpu_device(threads, 32);
    Simulation simulation(*device, start.model, start.state, plan, without_bounce);
    simulation.advance(300);
    CHECK(simulation.contact_impulses().size() > 20);
    saved.push_back(simulation.save());
  }
  CHECK(saved[0] == saved[1]);
}

TEST_CASE("no motion of a resting body is cut short by a heavier one that comes at a fifth of an edge a step") {
  const bench::Partner sphere{.mesh = generate_mesh("icosphere:2")};
  for (const double mass : {1.0, 10.0, 1e6})
    for (const double elasticity : {0.0, 0.5}) {
      CAPTURE(mass, elasticity);
      bench::Partner heavy = sphere;
      heavy.mass = mass;
      const bench::Meeting meeting = bench::meeting_of(heavy, sphere, {.edges_a_step = 0.2, .left_comes = true});
      const auto device = make_cpu_device(1, 64);
      Simulation simulation(*device, meeting.start.model, meeting.start.state, plan_of(Method{"verlet", meeting.time_step}),
                            {.response = {"impulse"}, .elasticity = elasticity});
      const bench::Seen seen = bench::watch(simulation, meeting.start, {.steps = 60, .stride = 8});
      CHECK(seen.report.contact_steps > 10);
      CHECK(seen.report.reverted_vertices == 0);
      CHECK(seen.touching == 0);
      CHECK(seen.momentum_change < 1e-14);
    }
}

TEST_CASE("a light body that still owes for motions cut short flies on with all of its momentum") {
  bench::Partner light{.mesh = generate_mesh("icosphere:2")}, heavy = light;
  heavy.mass = 1000;
  const bench::Meeting meeting = bench::meeting_of(heavy, light, {.edges_a_step = 1, .omega_step = 0.5, .left_comes = true});
  const auto device = make_cpu_device(1, 64);
  Simulation simulation(*device, meeting.start.model, meeting.start.state, plan_of(Method{"cv8", meeting.time_step}),
                        {.response = {"impulse"}, .elasticity = 0.5, .gap = 0.01});  // with the usual gap nothing is cut
  const bench::Seen seen = bench::watch(simulation, meeting.start, {.steps = 200, .stride = 8});
  CHECK(seen.report.reverted_vertices > 20);
  CHECK(seen.momentum_change < 1e-13);  // of rounding, which is 1.4e-14 with AVX2
}

TEST_CASE("spheres meet at extremes of mass, radius and place, and momentum is kept") {
  struct Extreme {
    double mass, radius, far;
  };
  for (const auto& [mass, radius, far] : {Extreme{1e-6, 1, 0}, {1, 1e-3, 0}, {1e-9, 1e-3, 0}, {1, 1, 1e4}, {1e-3, 0.1, 1e4}})
    for (const int precision : {64, 32}) {
      CAPTURE(mass, radius, far, precision);
      bench::Partner large{.mesh = generate_mesh("icosphere:2")}, small = large;
      small.mass = mass;
      small.radius = radius;
      const bench::Meeting meeting = bench::meeting_of(large, small, {.edges_a_step = 0.2, .far_away = far});
      const auto device = make_cpu_device(1, precision);
      Simulation simulation(*device, meeting.start.model, meeting.start.state, plan_of(Method{"cv8", meeting.time_step}),
                            {.response = {"impulse"}, .elasticity = 0.5});
      const bench::Seen seen = bench::watch(simulation, meeting.start, {.steps = radius < 0.1 ? 300u : 60u, .stride = 16});
      CHECK(seen.report.contact_steps > 0);
      CHECK(seen.touching == 0);
      CHECK(seen.inside == 0);
      CHECK(seen.report.held_parts == 0);
      CHECK(seen.momentum_change < (precision == 64 ? 1e-14 : 1e-7));
    }
}

TEST_CASE("free bodies lose in an impact what contacts take") {
  for (const double friction : {0.0, 0.5})
    for (const double elasticity : {0.0, 1.0}) {
      CAPTURE(friction, elasticity);
      const bench::Partner sphere{.mesh = generate_mesh("icosphere:2")};
      const bench::Meeting meeting = bench::meeting_of(sphere, sphere, {.edges_a_step = 0.05, .omega_step = 0.1});
      const auto device = make_cpu_device(2, 64);
      Simulation simulation(*device, meeting.start.model, meeting.start.state, plan_of(Method{"cv8", meeting.time_step}),
                            {.response = {"impulse"}, .elasticity = elasticity, .friction = friction});
      ThreadPool pool(1);
      const double before = measure(meeting.start.model, meeting.start.state, glm::dvec3(0.0), pool).energy();
      simulation.advance(120);
      const double after = measure(meeting.start.model, simulation.state(), glm::dvec3(0.0), pool).energy();
      const ResponseReport contacts = simulation.report().response;
      CHECK(contacts.energy_taken > 0.01 * before);
      CHECK(after - before == Approx(contacts.energy_given - contacts.energy_taken).epsilon(1e-6));
      CHECK((friction > 0 ? contacts.friction_work > 0 : contacts.friction_work == 0));
    }
}

TEST_CASE("what slides on a plane loses what friction takes") {
  BodySetup cube = resting("cube:3", "cube", 1, 1, 1e5);  // so stiff that it hardly leans
  cube.description.rotation = {0, 20, 0};
  cube.description.position = {0, 0.53, 0};
  cube.description.velocity = {1.5, 0, 0.5};
  cube.description.damping = 0;
  const glm::dvec3 gravity(0, -9.81, 0);
  const GroundDescription ground;
  const ModelAndState start = build_model({&cube, 1}, gravity, {&ground, 1});
  const auto device = make_cpu_device(1, 64);
  Simulation simulation(*device, start.model, start.state, plan_of(Method{"cv8", 0.001}),
                        {.response = {"impulse"}, .elasticity = 0, .friction = 0.2});
  ThreadPool pool(1);
  const auto kinetic_along = [&](const Measurement& m) {  // of the body as a whole, 1 kg
    return 0.5 * (m.momentum.x * m.momentum.x + m.momentum.z * m.momentum.z);
  };
  simulation.advance(50);
  const Measurement before = measure(start.model, simulation.state(), gravity, pool);
  const ResponseReport first = simulation.report().response;
  simulation.advance(500);
  const Measurement after = measure(start.model, simulation.state(), gravity, pool);
  const ResponseReport last = simulation.report().response;
  const double friction = last.friction_work - first.friction_work;
  CHECK(friction == Approx(kinetic_along(before) - kinetic_along(after)).epsilon(0.01));
  // All that contacts took: a pressed vertex has half a step of gravity's more or less at the ends.
  const double net = (last.energy_given - first.energy_given) - (last.energy_taken - first.energy_taken);
  CHECK(after.energy() - before.energy() == Approx(net).epsilon(0.002));
}

}  // namespace
}  // namespace pliant
