// Makes single runs of the suite `precision`, by pliant and by other libraries, and the reference to compare them with.
#pragma once
#include <cstdint>

#include "bench/peers/peers.hpp"
#include "bench/precision/cases.hpp"
#include "device/device.hpp"

namespace pliant::bench {

struct Run {
  double seconds = 0;               // time to integrate, without setting up
  std::uint64_t evaluations = 0;    // of all forces of a body, including those of rejected steps
  std::uint64_t contact_steps = 0;  // steps with a contact
  Ending ending;                    // not finite if the run failed
};

/// Runs the case in steps of one length.
[[nodiscard]] Run run_steps(Device& device, const PrecisionCase& what, const Integrator& integrator, std::uint64_t steps);
/// Runs the case in steps that `tolerance` governs. The last one ends exactly at the end. Expects a method that can meet a
/// tolerance.
[[nodiscard]] Run run_tolerance(Device& device, const PrecisionCase& what, const Integrator& integrator, double tolerance);
/// Runs the case with another library. `effort` is a number of steps, or a tolerance if the method is adaptive.
[[nodiscard]] Run run_peer(PeerSystem& system, const PrecisionCase& what, const PeerMethod& method, double effort);

struct Reference {
  Ending ending;
  double error = 0;  // distance to a reference with steps twice as long
};

/// Integrates the reference with vern8.
[[nodiscard]] Reference find_reference(Device& device, const PrecisionCase& what);

}  // namespace pliant::bench
