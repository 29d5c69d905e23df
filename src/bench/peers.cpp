#include "bench/peers.hpp"

#include <cmath>
#include <iterator>

namespace pliant::bench {

std::vector<PeerMethod> peer_methods(bool damped) {
  std::vector<PeerMethod> all = arkode_methods();
  std::vector<PeerMethod> more = odeint_methods();
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  if (damped) std::erase_if(all, [](const PeerMethod& method) { return !method.damps; });
  return all;
}

std::vector<std::string> missing_peers() {
  std::vector<std::string> missing;
  if (arkode_methods().empty()) missing.emplace_back("ARKODE: left out, as the build did not find it (Debian: libsundials-dev)");
  if (odeint_methods().empty()) missing.emplace_back("odeint: left out, as the build did not find it (Debian: libboost-dev)");
  return missing;
}

double size_of_numbers(const std::vector<double>& state) {
  double sum = 0;
  for (const double number : state) sum += number * number;
  return std::sqrt(sum / static_cast<double>(state.size()));
}

}  // namespace pliant::bench
