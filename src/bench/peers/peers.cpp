#include "bench/peers/peers.hpp"

#include <cmath>
#include <iterator>

namespace pliant::bench {

std::vector<PeerMethod> peer_methods(bool damped) {
  std::vector<PeerMethod> all;
  for (std::vector<PeerMethod> of_one : {arkode_methods(), cvode_methods(), odeint_methods()})
    all.insert(all.end(), std::make_move_iterator(of_one.begin()), std::make_move_iterator(of_one.end()));
  if (damped) std::erase_if(all, [](const PeerMethod& method) { return !method.damps; });
  return all;
}

std::vector<std::string> missing_peers() {
  std::vector<std::string> missing;
  if (sundials_version().empty())
    missing.emplace_back("ARKODE and CVODE: left out, as the build did not find SUNDIALS; `tools/build comparisons` adds it");
  if (boost_version().empty())
    missing.emplace_back("odeint: left out, as the build did not find Boost; `tools/build comparisons` adds it");
  return missing;
}

double size_of_numbers(const std::vector<double>& state) {
  double sum = 0;
  for (const double number : state) sum += number * number;
  return std::sqrt(sum / static_cast<double>(state.size()));
}

}  // namespace pliant::bench
