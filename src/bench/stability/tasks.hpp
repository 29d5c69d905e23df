// What the suite `stability` does: a list of tasks, each of which measures one row.
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

inline constexpr double small_amplitude = 1e-3;  // of breathing motion, where limits are those of linear theory

/// One for each device and precision, opened when first needed. Small bodies are fastest on one thread of the CPU.
class StabilityDevices {
 public:
  explicit StabilityDevices(const Selection& selection) : selection_(selection) {}

  [[nodiscard]] Device& at(const Place& place, std::uint32_t vertices);
  /// fp64 and fp32 on the CPU, then the GPU.
  [[nodiscard]] std::vector<Place> all() const;

 private:
  Selection selection_;
  std::map<std::string, std::unique_ptr<Device>> open_;
};

struct StabilityTask {
  std::string name;
  double cost = 0;  // in units that all tasks share
  std::function<StabilityRow()> measure;
};

class StabilityTasks {
 public:
  /// `devices` must outlive the tasks.
  StabilityTasks(bool is_quick, StabilityDevices& devices) : is_quick_(is_quick), devices_(devices) {}

  /// `steps`: about as many as `measure` takes.
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

/// How long a step may be: rows of kind limit.
void add_limits(StabilityTasks& tasks);
/// How motions end, by step and damping: rows of kind map.
void add_maps(StabilityTasks& tasks);
/// What 100,000 steps do to the energy: rows of kind drift.
void add_drifts(StabilityTasks& tasks);
/// How far fp32 strays from fp64: rows of kind error.
void add_errors(StabilityTasks& tasks);

}  // namespace pliant::bench
