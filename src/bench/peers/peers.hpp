// Runs other libraries' integrators for comparison: SUNDIALS's ARKODE and CVODE and Boost.odeint, if the build found them.
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
  bool damps = true;      // it can take forces that depend on velocities

  /// Integrates `state` over `duration` [s]. `effort` is a number of steps or, if the method is adaptive, a tolerance. The
  /// tolerance is relative, and also absolute in units of the start's root mean square. Returns the seconds spent, without
  /// setting up. If it fails, the state is not finite.
  std::function<double(PeerSystem& system, std::vector<double>& state, double duration, double effort)> integrate;
};

inline constexpr std::array<std::string_view, 3> peer_libraries{"ARKODE", "CVODE", "odeint"};

/// Each of the next three is empty if the build did not find the package.
[[nodiscard]] std::vector<PeerMethod> arkode_methods();
[[nodiscard]] std::vector<PeerMethod> cvode_methods();
[[nodiscard]] std::vector<PeerMethod> odeint_methods();
/// Return such as "6.4.1", or an empty text if the build did not find the package.
[[nodiscard]] std::string sundials_version();
[[nodiscard]] std::string boost_version();

/// Returns all methods or, if `damped`, those that can take damping.
[[nodiscard]] std::vector<PeerMethod> peer_methods(bool damped);
/// Returns a sentence for each library that the build did not find.
[[nodiscard]] std::vector<std::string> missing_peers();

/// Returns the root mean square of the numbers, for absolute tolerances.
[[nodiscard]] double size_of_numbers(const std::vector<double>& state);

}  // namespace pliant::bench
