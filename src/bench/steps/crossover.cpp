#include "bench/steps/crossover.hpp"

#include <cmath>
#include <iterator>
#include <map>

namespace pliant::bench {
namespace {

// Returns the logarithm of the GPU's time over the CPU's, by the logarithm of vertices.
std::map<double, double> log_ratios(std::span<const SizedTime> cpu, std::span<const SizedTime> gpu) {
  std::map<double, double> ratios;
  for (const SizedTime& c : cpu)
    for (const SizedTime& g : gpu)
      if (c.vertices == g.vertices) ratios[std::log(c.vertices)] = std::log(g.milliseconds / c.milliseconds);
  return ratios;
}

}  // namespace

Crossover find_crossover(std::span<const SizedTime> cpu, std::span<const SizedTime> gpu) {
  const std::map<double, double> ratios = log_ratios(cpu, gpu);
  if (ratios.empty()) return {};
  if (ratios.rbegin()->second >= 0) return {Lead::cpu_everywhere, {}};  // the CPU leads at the largest size
  for (auto above = ratios.rbegin(), below = std::next(above); below != ratios.rend(); ++above, ++below)
    if (below->second >= 0) {
      const double part = below->second / (below->second - above->second);
      return {Lead::crosses, std::exp(below->first + part * (above->first - below->first))};
    }
  return {Lead::gpu_everywhere, {}};
}

}  // namespace pliant::bench
