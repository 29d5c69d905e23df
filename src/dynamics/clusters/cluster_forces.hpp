// Records the passes that sum the springs of clustered bodies on a device.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/thread_pool.hpp"
#include "device/pass.hpp"
#include "dynamics/clusters/cluster_tree.hpp"
#include "dynamics/clusters/force_sums.hpp"
#include "model/model.hpp"
#include "physics/control.glsl"
#include "state/device_bodies.hpp"

namespace pliant {

/// How inexact a body's sums are: root mean squares over vertices, in the body's unit.
struct ClusterErrors {
  double error = 0, sum = 0, size = 0;     // over sampled vertices: of the error, of the sum, of the sum of its parts' sizes
  double handed_down = 0, sum_of_all = 0;  // over all vertices: of what clusters hand down, and of the sum

  /// Returns the error over the sum. Where few vertices carry most of a force, no sample may show that. Then it is a twentieth of
  /// what clusters hand down, for it has never been less where something was measured.
  [[nodiscard]] double relative() const;
};

/// Returns how many threads make lists of clusters. As many sum a body's energies after a change of lists.
[[nodiscard]] unsigned list_threads(const DeviceInfo& device);

/// The trees of a model's bodies, and the threads that list pairs of clusters. Each is made when it is first asked for.
class ClusterTrees {
 public:
  explicit ClusterTrees(unsigned threads) : threads_(threads) {}
  [[nodiscard]] std::shared_ptr<const ClusterTree> of(const Model& model, std::uint32_t body);
  [[nodiscard]] ThreadPool& pool();

 private:
  unsigned threads_;
  std::unique_ptr<ThreadPool> pool_;
  std::vector<std::shared_ptr<const ClusterTree>> trees_;
};

class ClusterForces {
 public:
  /// Makes the arrays. `bases` has one for each body that is clustered. `bodies` must outlive this. Throws Error (input) if lists
  /// would be too long. It has made no array then. Throws Error (device) if a GPU has no room or there are too few threads, and
  /// std::bad_alloc if the processor has no room. Some arrays may be new then, so those of before do not hold together.
  ClusterForces(DeviceBodies& bodies, const Model& model, std::span<const std::optional<ListBasis>> bases, ClusterTrees& trees);

  /// Returns passes that set `spring_sum` at the placements in a slot, for clustered bodies that move and are deformed. With
  /// `only_stale` they leave out bodies whose kept forces still hold. Sums of all others are undefined.
  [[nodiscard]] std::vector<Pass> passes(std::uint32_t slot, bool only_stale) const;

  /// Returns passes that do the same for a stage, and then measure errors.
  [[nodiscard]] std::vector<Pass> measuring_passes(std::uint32_t slot) const;
  /// Returns what those have measured, one for each body. It means nothing for bodies whose springs they have not summed.
  [[nodiscard]] std::vector<ClusterErrors> errors() const;

  /// Returns how many springs a sum of this body's has. 0: it is not clustered.
  [[nodiscard]] std::uint64_t springs_of(std::size_t body) const { return springs_of_bodies_[body]; }

 private:
  // Springs of leaves of samples are summed, too, if they stand before the end.
  [[nodiscard]] std::vector<Pass> passes_up_to(std::uint32_t end_leaf, std::uint32_t slot, bool only_stale) const;
  [[nodiscard]] Pass group_pass(std::string_view name, std::uint32_t items, const Parameters& parameters,
                                std::uint32_t threads = physics::group_size) const;

  // Leaves of samples stand behind all others.
  struct Leaves {
    std::uint32_t body, vertices, first, end, first_sample, end_sample;
  };

  const DeviceBodies* bodies_;
  std::vector<std::uint64_t> springs_of_bodies_;
  std::vector<Leaves> leaves_of_bodies_;
  std::uint32_t leaf_count_ = 0, leaves_and_samples_ = 0, cluster_count_ = 0;
};

}  // namespace pliant
