// Lists the tasks of the suite `stability`. Each task measures one row.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/common/place.hpp"
#include "bench/stability/stability.hpp"

namespace pliant::bench {

inline constexpr double small_amplitude = 1e-3;  // of breathing motion; limits are those of linear theory

/// Opens one device for each place when it is first needed. Small bodies get one thread of the CPU, which is fastest for them.
class StabilityDevices {
 public:
  explicit StabilityDevices(const Selection& selection) : selection_(selection) {}

  [[nodiscard]] Device& at(const Place& place, std::uint32_t vertices);
  /// Returns fp64 and fp32 on the CPU, and then the GPU, as far as they are selected.
  [[nodiscard]] std::vector<Place> all() const;

 private:
  Selection selection_;
  std::map<std::string, std::unique_ptr<Device>> open_;
};

struct StabilityTask {
  std::string name;
  double cost = 0;  // in a unit that all tasks share
  std::function<StabilityRow()> measure;
};

class StabilityTasks {
 public:
  /// `devices` must outlive the tasks.
  StabilityTasks(bool is_quick, StabilityDevices& devices) : is_quick_(is_quick), devices_(devices) {}

  /// Adds a task. `steps` is about the number of steps that `measure` makes.
  void add(const std::string& what, const Integrator& integrator, const Place& place, std::uint32_t vertices, double steps,
           std::function<StabilityRow(Device&)> measure);

  [[nodiscard]] bool is_quick() const { return is_quick_; }
  [[nodiscard]] std::vector<Place> places() const { return devices_.all(); }
  [[nodiscard]] const std::vector<StabilityTask>& all() const { return tasks_; }

 private:
  bool is_quick_;
  StabilityDevices& devices_;
  std::vector<StabilityTask> tasks_;
};

/// Adds rows of kind limit: how long a step may be.
void add_limits(StabilityTasks& tasks);
/// Adds rows of kind map: how motions end, by step and damping.
void add_maps(StabilityTasks& tasks);
/// Adds rows of kind drift: what 100,000 steps do to the energy.
void add_drifts(StabilityTasks& tasks);
/// Adds rows of kind error: how far fp32 strays from fp64.
void add_errors(StabilityTasks& tasks);

}  // namespace pliant::bench
