// Other libraries' integrators, for comparison: SUNDIALS's ARKODE and CVODE and Boost.odeint, where the build found them.
#pragma once
#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/peers/system.hpp"

namespace pliant::bench {

struct PeerMethod {
  std::string library;    // one of peer_libraries
  std::string name;       // the library's, in short
  bool adaptive = false;  // the library chooses its steps by a tolerance
  bool damps = true;      // whether it takes forces that depend on velocities

  /// Takes `state` on by `duration` [s], in `effort` steps or with tolerance `effort`; relative, and absolute in units of the
  /// start's root mean square. Answers the seconds spent, without setting up. Where it fails the state is not finite.
  std::function<double(PeerSystem& system, std::vector<double>& state, double duration, double effort)> integrate;
};

inline constexpr std::array<std::string_view, 3> peer_libraries{"ARKODE", "CVODE", "odeint"};

/// Empty where the package was not there.
[[nodiscard]] std::vector<PeerMethod> arkode_methods();
[[nodiscard]] std::vector<PeerMethod> cvode_methods();
[[nodiscard]] std::vector<PeerMethod> odeint_methods();
/// Such as "6.4.1"; empty where the package was not there.
[[nodiscard]] std::string sundials_version();
[[nodiscard]] std::string boost_version();

/// Of all, those that can meet the system's damping.
[[nodiscard]] std::vector<PeerMethod> peer_methods(bool damped);
/// The libraries that were not there when pliant was built; a sentence each.
[[nodiscard]] std::vector<std::string> missing_peers();

/// Root mean square, for absolute tolerances.
[[nodiscard]] double size_of_numbers(const std::vector<double>& state);

}  // namespace pliant::bench
