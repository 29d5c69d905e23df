// Watches how inexact the forces of clustered bodies are. Lists of clusters suit the rest shape, so errors grow where parts come
// together that are far from each other at rest. Then lists are made for the present shape, too, then more exact ones, and in the
// end a body's springs are summed one by one.
#pragma once
#include <any>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/bytes.hpp"
#include "dynamics/stepper.hpp"
#include "model/model.hpp"
#include "state/device_bodies.hpp"

namespace pliant {

/// What checks have found and done since the start.
struct ClusterReport {
  std::uint64_t checks = 0;           // of one body each
  double largest_error = 0;           // that was left after a check, relative
  std::uint64_t lists_made = 0;       // for another shape than that at rest, or more exact ones
  double energy_change = 0;           // by what other lists, or direct sums, have made of the elastic energy, sum of sizes [J]
  std::vector<std::uint32_t> direct;  // bodies that went over to direct sums

  bool operator==(const ClusterReport&) const = default;
};

class ClusterWatch {
 public:
  /// All must outlive the watch. `forces_of_a_step` says how often a step sums springs.
  ClusterWatch(DeviceBodies& bodies, const Model& model, Stepper& stepper, std::uint32_t forces_of_a_step);

  /// Returns the number of steps after which the next check is due. There is one before the first step.
  [[nodiscard]] std::uint64_t next_check() const { return next_check_; }
  /// Checks bodies that move and are deformed, after so many steps. Changes how springs are summed where errors are beyond the
  /// tolerance. `state` returns the state that the device is in, and is asked only then. Returns whether passes that were
  /// recorded before do not hold any more.
  [[nodiscard]] bool check(std::uint64_t steps, const std::function<State()>& state);

  /// Returns how springs are summed, one for each body, as a State has it.
  [[nodiscard]] const std::vector<std::shared_ptr<const ChangedSums>>& changed_sums() const { return changed_; }
  /// Sums springs as in a State.
  void use(const std::vector<std::shared_ptr<const ChangedSums>>& changed);
  [[nodiscard]] const ClusterReport& report() const { return report_; }
  /// Returns how many forces of vertices and nodes on a vertex so many evaluations of a body's forces had.
  [[nodiscard]] std::uint64_t interactions(std::size_t body, std::uint64_t evaluations) const;

  void save(ByteWriter& to) const;
  void restore(ByteReader& from);

 private:
  // What a body's evaluations had before its springs came to be summed in another way.
  struct Counted {
    std::uint64_t evaluations = 0, interactions = 0;
  };

  // Returns the errors of bodies whose springs are summed by clusters, and are to be summed at all. Others have none.
  [[nodiscard]] std::vector<std::optional<double>> measure();
  void improve(std::size_t body, const State& state);
  void change(std::size_t body, const State& state, std::shared_ptr<const ChangedSums> sums);
  // Returns the energy of all springs with springs summed as they are now [J].
  [[nodiscard]] double energy_of(State state);
  [[nodiscard]] double limit_of(std::size_t body) const;

  DeviceBodies& bodies_;
  const Model& model_;
  Stepper& stepper_;
  std::uint64_t interval_, next_check_ = 0;
  std::vector<std::shared_ptr<const ChangedSums>> changed_;
  std::vector<std::uint32_t> changes_;     // by bodies
  std::vector<std::uint8_t> is_strained_;  // by bodies: no lists have met the tolerance, but all springs are not worth it yet
  std::vector<Counted> counted_;           // by bodies
  std::any energies_;
  ClusterReport report_;
};

}  // namespace pliant
