// summary.json, read back.
#include "output/summary.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "core/error.hpp"
#include "core/read_text.hpp"
#include "support/json.hpp"
#include "support/scratch.hpp"

namespace pliant {
namespace {

using namespace test;

ReadJson written(const Summary& summary) {
  const ScratchFolder folder;
  write_summary(folder.path / "summary.json", summary);
  return ReadJson::parse(read_text(folder.path / "summary.json"));
}

}  // namespace

TEST_CASE("a summary has every key that scripts rely on") {
  const ReadJson json = written({});
  using Names = std::vector<std::string>;
  CHECK(json.keys() == Names{"scene",         "device",
                             "precision",     "threads",
                             "ranks",         "integrator",
                             "time_step",     "adaptive",
                             "steps",         "simulated_seconds",
                             "wall_seconds",  "steps_per_second",
                             "energy",        "contacts",
                             "scripts",       "clusters",
                             "bodies_asleep", "final_intersecting_pairs",
                             "non_finite",    "interrupted",
                             "warnings",      "work",
                             "skipped",       "timings_ms",
                             "version"});
  CHECK(json["device"].keys() == Names{"kind", "name"});
  CHECK(json["energy"].keys() == Names{"initial", "final", "max_drift", "slept"});
  CHECK(json["contacts"].keys() == Names{"steps", "pairs_max", "reverted_vertices", "substeps", "held_parts", "energy_given",
                                         "energy_taken", "friction_work", "work_of_scripts"});
  CHECK(json["work"].keys() ==
        Names{"force_evaluations", "pair_interactions", "nodes_refitted", "node_tests", "triangle_tests", "cluster_checks"});
  CHECK(json["skipped"].is_object());
  CHECK(json["timings_ms"].is_object());
}

TEST_CASE("a summary's values read back as they were") {
  Summary summary;
  summary.scene = "scenes/\"two\" spheres.toml";
  summary.device.kind = "gpu";
  summary.time_step = 0.1;
  summary.steps = 1ull << 40;
  summary.energy.initial = 1.0 / 3;
  summary.energy.final = 2.5;
  summary.energy.max_drift = 1e-7;
  summary.energy.slept = 0.25;
  summary.bodies_asleep = 3;
  summary.contacts = {.steps = 2,
                      .pairs_max = 17,
                      .reverted_vertices = 5,
                      .substeps = 7,
                      .held_parts = 4,
                      .energy_given = 0.25,
                      .energy_taken = 0.5,
                      .friction_work = 0.125,
                      .work_of_scripts = 1.5};
  summary.scripts = {{"plate", 1.25, 0.5, 9}};
  summary.clusters = {0.125, 3, 0.5, {"sphere"}};
  summary.work.cluster_checks = 12;
  summary.work.triangle_tests = 99;
  summary.skipped = {{"forces", 3}, {"collision", 4}};
  summary.timings_ms = {{"step", 1.25}};
  summary.pass_timings_ms = {{"refit", 0.25}};
  const ReadJson json = written(summary);
  CHECK(json["scene"] == summary.scene);
  CHECK(json["device"]["kind"] == "gpu");
  CHECK(json["time_step"] == 0.1);
  CHECK(json["adaptive"].is_null());
  CHECK(json["steps"] == summary.steps);
  CHECK(json["energy"]["initial"] == summary.energy.initial);
  CHECK(json["energy"]["final"] == 2.5);
  CHECK(json["energy"]["max_drift"] == 1e-7);
  CHECK(json["energy"]["slept"] == 0.25);
  CHECK(json["bodies_asleep"] == 3);
  const ReadJson contacts = json["contacts"];
  CHECK((contacts["steps"] == 2 && contacts["pairs_max"] == 17 && contacts["reverted_vertices"] == 5));
  CHECK((contacts["substeps"] == 7 && contacts["energy_given"] == 0.25 && contacts["energy_taken"] == 0.5));
  CHECK((contacts["held_parts"] == 4 && contacts["friction_work"] == 0.125 && contacts["work_of_scripts"] == 1.5));
  const ReadJson plate = json["scripts"]["plate"];
  CHECK((plate["time"] == 1.25 && plate["waited"] == 0.5 && plate["waits"] == 9));
  CHECK(json["work"]["triangle_tests"] == 99);
  CHECK(json["work"]["cluster_checks"] == 12);
  const ReadJson clusters = json["clusters"];
  CHECK((clusters["largest_error"] == 0.125 && clusters["lists_made"] == 3 && clusters["energy_change"] == 0.5));
  CHECK((clusters["direct"].size() == 1 && clusters["direct"][0] == "sphere"));
  CHECK(json["skipped"].keys() == std::vector<std::string>{"forces", "collision"});
  CHECK(json["timings_ms"]["step"] == 1.25);
  CHECK(json["timings_ms"]["passes"]["refit"] == 0.25);
}

TEST_CASE("an energy that lists of clusters changed by nobody knows how much is null") {
  Summary summary;
  summary.clusters.emplace().energy_change = std::numeric_limits<double>::quiet_NaN();
  CHECK(written(summary)["clusters"]["energy_change"].is_null());
}

TEST_CASE("steps that a tolerance governs have no one length, but are counted") {
  Summary summary;
  summary.adaptive = {
      .tolerance = 1e-6, .accepted = 5, .rejected = 2, .rejected_in_contact = 1, .smallest_step = 0.25, .largest_step = 0.5};
  const ReadJson json = written(summary);
  CHECK(json["time_step"].is_null());
  CHECK(json["adaptive"].keys() ==
        std::vector<std::string>{"tolerance", "accepted", "rejected", "rejected_in_contact", "smallest_step", "largest_step"});
  CHECK(json["adaptive"]["tolerance"] == 1e-6);
  CHECK(json["adaptive"]["accepted"] == 5);
  CHECK(json["adaptive"]["rejected"] == 2);
  CHECK(json["adaptive"]["rejected_in_contact"] == 1);
  CHECK(json["adaptive"]["smallest_step"] == 0.25);
  CHECK(json["adaptive"]["largest_step"] == 0.5);
}

TEST_CASE("what is not a finite number is null") {
  Summary summary;
  summary.energy.final = std::numeric_limits<double>::quiet_NaN();
  summary.steps_per_second = std::numeric_limits<double>::infinity();
  const ReadJson json = written(summary);
  CHECK(json["energy"]["final"].is_null());
  CHECK(json["energy"]["max_drift"].is_null());
  CHECK(json["steps_per_second"].is_null());
  CHECK(json["final_intersecting_pairs"].is_null());
}

TEST_CASE("a path that is no UTF-8 does not stop the summary") {
  Summary summary;
  summary.scene = "sch\xF6n.toml";
  CHECK(written(summary)["scene"].get<std::string>().find("sch") == 0);
}

TEST_CASE("a summary on a full disk is an error") { CHECK_THROWS_AS(write_summary("/dev/full", {}), Error); }

}  // namespace pliant
