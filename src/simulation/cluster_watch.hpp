// Watches how inexact the forces of clustered bodies are. Lists of clusters suit the rest shape, so errors grow where parts come
// together that are far from each other at rest. Then lists are made for the present shape, too, then more exact ones, and in the
// end a body's springs are summed one by one.
#pragma once
#include <cstdint>
#include <functional>
#include <future>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dynamics/clusters/cluster_tree.hpp"
#include "dynamics/stepper.hpp"
#include "model/model.hpp"
#include "state/device_bodies.hpp"

namespace pliant {

/// What checks have found and done since the start.
struct ClusterReport {
  std::uint64_t checks = 0;           // of one body each
  double largest_error = 0;           // of forces over the forces, at any check. Of the first one what it has left counts
  double largest_excess = 0;          // of those errors over their body's tolerance
  std::uint32_t worst_body = 0;       // which that was; 0 while no body has erred
  std::uint64_t lists_made = 0;       // for another shape than that at rest, or more exact ones
  std::vector<std::uint32_t> direct;  // bodies that went over to direct sums

  bool operator==(const ClusterReport&) const = default;
};

/// Returns the size of the change of a body's elastic energy at these displacements [m] from the lists of `before` to those of
/// `after` [J]. Null stands for the first lists. Neither may be direct sums. `tree` has been made of `rest` [m]. Returns NaN if
/// there is no memory or thread. It takes all by value, so that memory is free when the call ends.
[[nodiscard]] double energy_change_of(ModelBody body, std::shared_ptr<const ClusterTree> tree, unsigned threads,
                                      std::shared_ptr<const ChangedSums> before, std::shared_ptr<const ChangedSums> after,
                                      std::vector<glm::dvec3> rest, std::vector<glm::dvec3> displacements);

/// Returns the accuracy (tau) of lists to try after some of this accuracy, or nothing if those were the finest. `excess` is their
/// error over the tolerance. With `aims` the next ones should err by 0.7 times the tolerance. If that takes nearly the finest
/// lists, those come at once: one try more would cost more than it saves.
[[nodiscard]] std::optional<double> next_accuracy(double accuracy, double excess, double finest, bool aims);

class ClusterWatch {
 public:
  /// All must outlive the watch. It checks each half period of the fastest vibration by steps of this length [s], or after each
  /// third step if they have no fixed length.
  ClusterWatch(DeviceBodies& bodies, const Model& model, Stepper& stepper, std::optional<double> time_step);

  /// Returns the number of steps after which the next check is due. There is one before the first step.
  [[nodiscard]] std::uint64_t next_check() const { return next_check_; }
  /// Checks bodies that move and are deformed, after so many steps. Changes how springs are summed where errors are beyond the
  /// tolerance. `state` returns the state that the device is in, and is asked only then. Returns whether passes that were
  /// recorded before do not hold any more.
  [[nodiscard]] bool check(std::uint64_t steps, const std::function<State()>& state);

  /// Makes its passes anew. They hold until a parameter of all kernels changes.
  void record();

  /// Returns how springs are summed, one for each body, as a State has it.
  [[nodiscard]] const std::vector<std::shared_ptr<const ChangedSums>>& changed_sums() const { return changed_; }
  /// Sums springs as in a State. Returns whether passes that were recorded before do not hold any more.
  bool use(const std::vector<std::shared_ptr<const ChangedSums>>& changed);
  [[nodiscard]] ClusterReport report() const;
  /// Returns by how much other lists have changed the elastic energy: the sum of sizes. Direct sums do not count [J]. That is
  /// found out while steps go on, and this waits for it. Energies of each change are summed on list_threads() threads. Returns
  /// NaN if there was no memory or thread for that.
  [[nodiscard]] double energy_change();
  /// Whether energy_change() and save() would not wait.
  [[nodiscard]] bool knows_energy_change() const;
  /// Returns how many forces of one point on another so many evaluations of a body's forces had.
  [[nodiscard]] std::uint64_t interactions(std::size_t body, std::uint64_t evaluations) const;

  /// Returns as bytes all that later checks and reports depend on.
  [[nodiscard]] std::string save();
  /// Goes on from bytes of save(). Without any it goes on from a simulation that had no clusters. Returns whether passes that
  /// were recorded before do not hold any more.
  bool restore(std::string_view saved);

 private:
  // What a body's evaluations had before its springs came to be summed in another way.
  struct Counted {
    std::uint64_t evaluations = 0, interactions = 0;
  };

  // Returns the errors of bodies whose springs are summed by clusters, and are to be summed at all. Others have none, and no body
  // has any after a breakdown.
  [[nodiscard]] std::vector<std::optional<double>> measure();
  // Returns the error that remains.
  double improve(std::size_t body, const State& state, double error);
  // Adds the first of the changes that are still to be added, and waits for it.
  void add_energy_change();
  // Counts new lists. Begins to find out how they change the energy, while steps go on.
  void note_lists(std::size_t body, const State& state, const std::shared_ptr<const ChangedSums>& before);
  void change(std::size_t body, std::shared_ptr<const ChangedSums> sums);
  [[nodiscard]] double limit_of(std::size_t body) const;

  DeviceBodies& bodies_;
  const Model& model_;
  Stepper& stepper_;
  std::uint64_t interval_, next_check_ = 0;
  std::vector<Pass> measuring_;
  std::vector<std::shared_ptr<const ChangedSums>> changed_;
  std::vector<Counted> counted_;                     // by bodies
  ClusterReport report_;                             // but for `direct`
  double energy_change_ = 0;                         // of those that have been added [J]
  std::vector<std::future<double>> energy_changes_;  // that are still to be added [J]
};

}  // namespace pliant
