// Single runs of the suite `precision`, by pliant and by other libraries, and the truth they are held against.
#pragma once
#include <cstdint>

#include "bench/peers/peers.hpp"
#include "bench/precision/cases.hpp"
#include "device/device.hpp"

namespace pliant::bench {

struct Run {
  double seconds = 0;               // of integrating, without setting up
  std::uint64_t evaluations = 0;    // of all forces of a body, those of rejected steps included
  std::uint64_t contact_steps = 0;  // steps with a contact
  Ending ending;                    // not finite where the run failed
};

/// In steps of one length.
[[nodiscard]] Run run_steps(Device& device, const PrecisionCase& what, const Integrator& integrator, std::uint64_t steps);
/// In steps that `tolerance` governs, the last of which ends exactly at the end. Expects a method that bears one.
[[nodiscard]] Run run_tolerance(Device& device, const PrecisionCase& what, const Integrator& integrator, double tolerance);
/// `effort`: steps, or a tolerance where the method is adaptive.
[[nodiscard]] Run run_peer(PeerSystem& system, const PrecisionCase& what, const PeerMethod& method, double effort);

struct Reference {
  Ending ending;
  double error = 0;  // its distance from one with steps twice as long
};

/// By vern8.
[[nodiscard]] Reference find_reference(Device& device, const PrecisionCase& what);

}  // namespace pliant::bench
