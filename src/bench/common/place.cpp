#include "bench/common/place.hpp"

#include <fmt/format.h>

#include "core/thread_pool.hpp"

namespace pliant::bench {

std::unique_ptr<Device> open(const Place& place) {
  return place.device == DeviceKind::gpu ? make_gpu_device(place.gpu_index) : make_cpu_device(place.threads, place.precision);
}

std::string name_of(const Place& place) {
  if (place.device == DeviceKind::gpu) return "gpu";
  return fmt::format("cpu, {} thread{}, fp{}", place.threads, place.threads == 1 ? "" : "s", place.precision);
}

std::vector<Place> places_of(const Selection& selection, std::span<const int> cpu_precisions) {
  std::vector<Place> places;
  if (selection.cpu) {
    const unsigned most = thread_count(selection.threads);
    for (const int precision : cpu_precisions) {
      places.push_back({.device = DeviceKind::cpu, .precision = precision, .threads = 1});
      if (most > 1) places.push_back({.device = DeviceKind::cpu, .precision = precision, .threads = most});
    }
  }
  if (selection.gpu) places.push_back({.device = DeviceKind::gpu, .gpu_index = selection.gpu_index});
  return places;
}

}  // namespace pliant::bench
