// Writes summary.json, which tells scripts what a run did. The members' names are the file's keys.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pliant {

struct Summary {
  using Count = std::pair<std::string, std::uint64_t>;
  using Duration = std::pair<std::string, double>;  // [ms]

  std::string scene;  // the file's name
  struct {
    std::string_view kind;  // "cpu" or "gpu"
    std::string name;
  } device;
  int precision = 32;  // of the forces [bits]
  unsigned threads = 1;
  std::size_t ranks = 1;
  std::string integrator;
  std::optional<double> time_step;  // [s]; empty with a tolerance
  std::uint64_t steps = 0;          // without rejected ones
  struct Adaptive {
    double tolerance = 0;
    std::uint64_t accepted = 0, rejected = 0;    // steps
    std::uint64_t rejected_in_contact = 0;       // part of the rejected steps
    double smallest_step = 0, largest_step = 0;  // accepted steps [s]
  };
  std::optional<Adaptive> adaptive;  // empty: steps are fixed
  double simulated_seconds = 0;
  double wall_seconds = 0;  // of stepping alone
  double steps_per_second = 0;
  struct {
    double initial = 0, final = 0;    // [J]
    std::optional<double> max_drift;  // relative; empty with damping or after contacts
    double slept = 0;                 // that sleep took [J]
  } energy;
  struct {
    std::uint64_t steps = 0;              // steps with a contact, or parts of steps if they fall into such
    std::uint64_t pairs_max = 0;          // most touching triangle pairs, or impulses, in one of them
    std::uint64_t reverted_vertices = 0;  // sum over the run
    std::uint64_t substeps = 0;           // parts that steps fell into, beyond one each
    std::uint64_t held_parts = 0;         // parts of steps in which no body moved
    double energy_given = 0, energy_taken = 0, friction_work = 0, work_of_scripts = 0;  // [J]
  } contacts;
  struct Script {
    std::string body;
    double time = 0, waited = 0;  // on its own clock, and what that is behind [s]
    std::uint64_t waits = 0;      // parts of steps in which it waited
  };
  std::vector<Script> scripts;  // of scripted bodies
  struct Clusters {
    std::optional<double> largest_error;  // of forces, relative, that a check found; empty: there was none
    std::uint64_t lists_made = 0;         // beside those for the rest shape
    double energy_change = 0;             // that came with them [J]; NaN: unknown
    std::vector<std::string> direct;      // bodies that went over to direct sums
  };
  std::optional<Clusters> clusters;                       // empty: no body is clustered
  std::uint64_t bodies_asleep = 0;                        // at the end
  std::optional<std::uint64_t> final_intersecting_pairs;  // empty if the state is not finite
  bool non_finite = false;
  bool interrupted = false;
  struct {
    std::uint64_t force_evaluations = 0;  // one evaluation is all forces of one body
    std::uint64_t pair_interactions = 0;
    std::uint64_t nodes_refitted = 0;
    std::uint64_t node_tests = 0;
    std::uint64_t triangle_tests = 0;
    std::uint64_t cluster_checks = 0;  // of one clustered body each
  } work;
  std::vector<std::string> warnings;  // before and after the run
  std::vector<Count> skipped;
  std::vector<Duration> timings_ms;       // parts of the run, in order
  std::vector<Duration> pass_timings_ms;  // stepping time by pass; empty: not measured
  std::string version;
};

/// Writes the summary. Numbers that are not finite become null. Throws Error (command_line) if the file can't be written.
void write_summary(const std::filesystem::path& path, const Summary& summary);

}  // namespace pliant
