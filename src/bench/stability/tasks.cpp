#include "bench/stability/tasks.hpp"

#include <fmt/format.h>

namespace pliant::bench {
namespace {

double cost_of(const Integrator& integrator, std::uint32_t vertices, double steps) {
  return steps * evaluations_per_step(integrator) * (0.5 * vertices * vertices + 500);
}

}  // namespace

Device& StabilityDevices::at(const Place& place, std::uint32_t vertices) {
  Place sized = place;
  sized.threads = vertices < 300 ? 1 : selection_.threads;
  std::unique_ptr<Device>& device = open_[name_of(sized)];
  if (!device) device = open(sized);
  return *device;
}

std::vector<Place> StabilityDevices::all() const {
  std::vector<Place> places;
  if (selection_.cpu) places = {{.device = DeviceKind::cpu, .precision = 64}, {.device = DeviceKind::cpu, .precision = 32}};
  if (selection_.gpu) places.push_back({.device = DeviceKind::gpu, .precision = 32, .gpu_index = selection_.gpu_index});
  return places;
}

void StabilityTasks::add(const std::string& what, const Integrator& integrator, const Place& place, std::uint32_t vertices,
                         double steps, std::function<StabilityRow(Device&)> measure) {
  tasks_.push_back({fmt::format("{}, {}, {} {}", what, integrator.name, name_of(place.device), place.precision),
                    cost_of(integrator, vertices, steps),
                    [=, &devices = devices_] { return measure(devices.at(place, vertices)); }});
}

}  // namespace pliant::bench
