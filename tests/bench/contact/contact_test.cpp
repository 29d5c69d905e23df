// The suite `contact`: its quick form shows what the whole one has to show, and its oracle tells bodies that touch from those
// that don't.
#include "bench/contact/contact.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "bench/contact/apart.hpp"
#include "bench/contact/meeting.hpp"
#include "bench/contact/report.hpp"
#include "bench/contact/witness.hpp"
#include "mesh/generators.hpp"
#include "support/json.hpp"

namespace pliant::bench {
namespace {

Meeting two_spheres(double distance) {
  const Partner sphere{.mesh = generate_mesh("icosphere:1")};
  return meeting_of(sphere, sphere, {.edges_a_step = 0.1, .distance = distance, .off_centre = 0});
}

TEST_CASE("bodies that are pushed into each other are not apart, and have vertices inside each other") {
  const Meeting meeting = two_spheres(0.5);
  const Model& model = meeting.start.model;
  const ApartOracle oracle(model);
  std::vector<glm::dvec3> positions = meeting.start.state.world_positions(model);
  CHECK(oracle.pairs_not_apart(positions) == 0);
  CHECK(oracle.vertices_inside_others(positions) == 0);
  CHECK(oracle.have_parted(positions));
  for (std::uint32_t i = 0; i < model.bodies[0].vertex_count; ++i) positions[i].x += 0.8;
  CHECK(oracle.pairs_not_apart(positions) > 10);
  CHECK(oracle.vertices_inside_others(positions) > 0);
  CHECK_FALSE(oracle.have_parted(positions));
}

TEST_CASE("two bodies meet as fast and as far from each other as asked for, without momentum together") {
  const Partner light{.mesh = generate_mesh("icosphere:1")}, heavy{.mesh = generate_mesh("cube:4"), .mass = 10};
  const Meeting meeting = meeting_of(light, heavy, {.edges_a_step = 0.3, .omega_step = 0.5, .distance = 2});
  const std::vector<glm::dvec3> velocities = meeting.start.state.world_velocities(meeting.start.model);
  const ModelBody &left = meeting.start.model.bodies[0], &right = meeting.start.model.bodies[1];
  const glm::dvec3 of_left = velocities[left.first_vertex], of_right = velocities[right.first_vertex];
  CHECK((of_left - of_right).x * meeting.time_step == Approx(0.3 * meeting.edge));
  CHECK(of_left.x == Approx(-10 * of_right.x));
  CHECK(left.radius == Approx(1));
  CHECK(right.radius == Approx(1));
}

TEST_CASE("momentum that is not a number counts as the largest change of all") {
  const Meeting meeting = two_spheres(0.5);
  Witness witness(meeting.start);
  State broken = meeting.start.state;
  broken.motion.back() = NAN;
  witness.look_at_place(broken);
  witness.look_at_place(meeting.start.state);
  CHECK(witness.seen.momentum_change == INFINITY);
}

TEST_CASE("the suite contact finds bodies apart, momentum kept, and no energy made", "[long]") {
  const ContactOptions options{.devices = {.cpu = true, .threads = 2}, .quick = true};
  const ContactResult result = bench_contact(options, [](double, std::string_view) { return true; });
  std::size_t apart = 0, impacts = 0, rests = 0;
  for (const ContactRow& any : result.rows) {
    if (const auto* row = std::get_if<ApartRow>(&any)) {
      CAPTURE(row->bodies, row->precision, row->edges_a_step);
      ++apart;
      CHECK((row->touching == 0 && row->inside == 0));
      CHECK(row->contact_parts > 0);
      CHECK(row->parted);
      if (row->precision == 32) CHECK(row->momentum_change < 2 * row->momentum_change_alone);
      CHECK(row->momentum_change < (row->precision == 64 ? 1e-14 : 1e-8));
      CHECK(row->angular_momentum_change < 1e-2);
      CHECK((row->most_energy < 1e-3 && row->last_energy < 1e-6));
    } else if (const auto* impact = std::get_if<ImpactRow>(&any); impact != nullptr && impact->response == "impulse") {
      CAPTURE(impact->integrator, impact->elasticity, impact->omega_step);
      ++impacts;
      CHECK((impact->kept > 0.7 && impact->kept < 1));
      CHECK(impact->most_energy < 1e-3);
    }
  }
  for (const ContactRow& any : result.rows)
    if (const auto* row = std::get_if<RestRow>(&any)) {
      CAPTURE(row->bodies, row->precision);
      ++rests;
      CHECK((row->contacts > 0 && row->cut_vertices == 0));
      CHECK((row->most_a_step < 1e-4 && row->drift < 1e-3));
    }
  CHECK(rests == 12);
  CHECK(apart == 12 + 16);
  CHECK(impacts == 9);
  const auto json = test::ReadJson::parse(to_json({}, options, result));
  CHECK(json["suite"] == "contact");
  CHECK(json["rows"].size() == result.rows.size());
  CHECK_THAT(to_table(result), Catch::Contains("heavy on light sphere") && Catch::Contains("reflect") &&
                                   Catch::Contains("0 pairs of triangles not apart"));
}

TEST_CASE("the suite contact makes one study alone if it is told to") {
  const ContactResult result = bench_contact({.devices = {.cpu = true, .threads = 2}, .only = ContactStudy::cost, .quick = true},
                                             [](double, std::string_view) { return true; });
  REQUIRE(result.rows.size() == 3);
  for (const ContactRow& any : result.rows) {
    const auto* row = std::get_if<CostRow>(&any);
    REQUIRE(row != nullptr);
    CHECK((row->contacts > 0 && row->microseconds > 0 && row->microseconds_apart > 0 && row->microseconds_without > 0));
  }
}

TEST_CASE("the suite contact measures self-contact of bodies that do not touch themselves") {
  const ContactResult result = bench_contact({.devices = {.cpu = true, .threads = 2}, .only = ContactStudy::self, .quick = true},
                                             [](double, std::string_view) { return true; });
  REQUIRE(result.rows.size() == 4);  // sphere and ring, in flight and at rest
  for (const ContactRow& any : result.rows) {
    const auto* row = std::get_if<SelfCostRow>(&any);
    REQUIRE(row != nullptr);
    CHECK((row->microseconds > 0 && row->microseconds_without > 0 && row->cut_vertices == 0));
  }
}

TEST_CASE("the suite contact ends early if it is told to, without rows of what was not done") {
  const ContactResult result =
      bench_contact({.devices = {.cpu = true, .threads = 2}, .quick = true}, [](double, std::string_view) { return false; });
  CHECK(result.interrupted);
  CHECK(result.rows.empty());
}

}  // namespace
}  // namespace pliant::bench
