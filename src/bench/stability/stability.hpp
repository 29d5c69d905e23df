// The suite `stability` measures
// - at which steps methods blow up, compared with predicted limits
// - what energy does over 100,000 steps
// - how far fp32 strays from fp64 over long runs: far from the world's origin, in fast rotation, and at any size
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bench/common/place.hpp"
#include "bench/stability/cases.hpp"

namespace pliant::bench {

struct StabilityOptions {
  Selection devices;
  bool quick = false;
};

// Members' names are the keys of the file. Every body is an icosphere of radius 1 m with m = 1 kg.

/// The longest stable step of a body in breathing motion of small amplitude, with constant damping or none. With larger
/// amplitudes it is the shortest step at which an undamped squashed body blows up. The prediction holds for small amplitudes
/// only.
struct LimitRow {
  std::string integrator;
  DeviceKind device = DeviceKind::cpu;
  int precision = 64;
  std::uint32_t vertices = 0;
  double stiffness = 0;                 // k [N/m]
  double damping = 0;                   // c [kg/s]; 0: undamped
  double amplitude = 0;                 // of the breathing, or how much the body is squashed
  std::uint64_t steps = 0;              // of each tried length
  double predicted_step = 0;            // [s]
  std::optional<double> measured_step;  // [s]; null: all tried lengths were stable
};

/// One cell of the map: how a squashed body that also drifts ends after some hundred steps.
struct MapRow {
  std::string integrator;
  DeviceKind device = DeviceKind::cpu;
  int precision = 32;
  std::uint32_t vertices = 0;
  double stiffness = 0;        // k [N/m]
  std::string law;             // "none", "constant" or "adaptive"
  double damping = 0;          // c [kg/s]
  double time_step = 0;        // [s]
  double undamped_bound = 0;   // [s]
  double predicted_bound = 0;  // with damping [s]
  std::uint64_t steps = 0;
  Outcome outcome = Outcome::stable;
  double energy_ratio = 0;  // end over start; null in the file if a vertex is not finite
};

/// Energy of an undamped breathing body. Compares the mean over the last thousand steps with that over the first.
struct DriftRow {
  std::string integrator;
  DeviceKind device = DeviceKind::cpu;
  int precision = 32;
  std::uint32_t vertices = 0;
  double omega_step = 0;  // step times the stiffest mode's frequency
  std::uint64_t steps = 0;
  double energy_drift = 0;     // relative
  double predicted_drift = 0;  // in exact arithmetic: what the method itself loses
};

/// One undamped run. `error` says how far it strays from the same run in fp64 on the CPU.
struct ErrorRow {
  std::string family;  // "far", "amplitude", "size" or "tumble"
  std::string integrator = {};
  DeviceKind device = DeviceKind::cpu;
  int precision = 32;
  std::uint32_t vertices = 0;
  double amplitude = 0;  // how much the body is squashed at the start
  double distance = 0;   // from the world's origin [m]
  double turns = 0;
  std::uint64_t steps = 0;
  /// Root mean square of the distances between positions at the end, over amplitude times radius. For a tumbling body it is over
  /// the radius alone. Null in the file for the fp64 run itself.
  ///
  /// For a tumbling body the fp64 row has the error of an fp64 run from the nudged() start instead. The body's own vibrations are
  /// chaotic, and after a thousand turns they leave no digit of where it points.
  std::optional<double> error = {};
  double energy_change = 0;            // relative
  double angular_momentum_change = 0;  // relative; 0 for bodies that do not tumble
  std::uint64_t frame_changes = 0;
};

using StabilityRow = std::variant<LimitRow, MapRow, DriftRow, ErrorRow>;

struct StabilityResult {
  std::vector<StabilityRow> rows;
  std::vector<std::string> notes;  // a summary of the rows
  bool interrupted = false;        // by Progress
};

/// Runs the suite. Throws Error (device).
[[nodiscard]] StabilityResult bench_stability(const StabilityOptions& options, const Progress& progress);

}  // namespace pliant::bench
