// Finds the size from which on the GPU is faster than the CPU.
#pragma once
#include <optional>
#include <span>

namespace pliant::bench {

struct SizedTime {
  double vertices = 0;
  double milliseconds = 0;  // both above zero
};

enum class Lead { none_measured, cpu_everywhere, gpu_everywhere, crosses };

struct Crossover {
  Lead lead = Lead::none_measured;
  std::optional<double> vertices;  // where it crosses, or crosses last: the GPU stays ahead from there on
};

/// Compares times at the sizes that both have. In between it interpolates the logarithm of the ratio of times over the logarithm
/// of vertices.
[[nodiscard]] Crossover find_crossover(std::span<const SizedTime> cpu, std::span<const SizedTime> gpu);

}  // namespace pliant::bench
