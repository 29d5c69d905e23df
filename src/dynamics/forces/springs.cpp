// Energies are summed per vertex, then over vertices in order.
#include "dynamics/forces/springs.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "core/expect.hpp"
#include "dynamics/clusters/cluster_springs.hpp"
#include "dynamics/clusters/force_sums.hpp"
#include "dynamics/forces/elongations.hpp"
#include "physics/layout.glsl"

namespace pliant {
namespace {

constexpr std::uint32_t springs_of_task = 8192;  // which take some 15 us

// Keeps the springs' energies from question to question. A body is summed again if a bit of its displacements has changed.
class SpringEnergies {
 public:
  explicit SpringEnergies(const Model& model)
      : sum_of_springs_(elongation_sum(cpu::available_isas().back())),
        energies_(model.vertex_count()),
        is_known_(model.bodies.size()),
        changed_sums_(model.bodies.size()),
        clustered_(model.bodies.size()) {
    for (int axis = 0; axis < 3; ++axis) {
      moved_[axis].resize(model.vertex_count() + elongation_lanes);
      rest_[axis].resize(model.vertex_count() + elongation_lanes);
      for (std::uint32_t i = 0; i < model.vertex_count(); ++i) rest_[axis][i] = model.rest_position(i)[axis];
    }
  }

  // Returns the energy of all bodies [J]. It is NaN if a stop left springs out.
  double sum(const EnergyQuestion& question) {
    PLIANT_EXPECT(energies_.size() == question.model.vertex_count() && is_known_.size() == question.model.bodies.size());
    const Model& model = question.model;
    note_changes(model, question.state, question.pool);
    const std::vector<Rows> tasks = tasks_of(model);
    question.pool.for_ranges(static_cast<std::uint32_t>(tasks.size()), 4, [&](std::uint32_t first, std::uint32_t end) {
      for (; first < end; ++first) sum_rows(model, tasks[first], question.stopped && question.stopped());
    });
    for (std::size_t b = 0; b < model.bodies.size(); ++b)
      if (is_clustered(model, b) && !is_known_[b]) sum_clusters(question, b);
    double sum = 0;
    for (const double energy : energies_) sum += energy;
    std::ranges::fill(is_known_, !std::isnan(sum));
    return sum;
  }

 private:
  // Vertices of one body.
  struct Rows {
    std::uint32_t first, end;
  };

  void note_changes(const Model& model, const State& state, ThreadPool& pool) {
    pool.for_ranges(static_cast<std::uint32_t>(model.bodies.size()), 16, [&](std::uint32_t first, std::uint32_t end) {
      for (std::uint32_t b = first; b < end; ++b) {
        const bool has_moved = move(model.bodies[b], state), has_other_sums = note_sums(b, state);
        if (has_moved || has_other_sums) is_known_[b] = false;
      }
    });
  }

  // Returns whether springs are summed in another way.
  bool note_sums(std::size_t b, const State& state) {
    std::shared_ptr<const ChangedSums> sums = state.changed_sums.empty() ? nullptr : state.changed_sums[b];
    if (sums == changed_sums_[b]) return false;
    changed_sums_[b] = std::move(sums);
    clustered_[b].reset();
    return true;
  }

  bool is_clustered(const Model& model, std::size_t b) const {
    return list_basis_of(model.bodies[b], changed_sums_[b].get()).has_value();
  }

  // Returns whether a bit has changed.
  bool move(const ModelBody& body, const State& state) {
    std::uint64_t changes = 0;
    for (std::uint32_t i = body.first_vertex; i < body.first_vertex + body.vertex_count; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        const double before = std::exchange(moved_[axis][i], state.displacement(i)[axis]);
        changes |= std::bit_cast<std::uint64_t>(before) ^ std::bit_cast<std::uint64_t>(moved_[axis][i]);
      }
    return changes != 0;
  }

  // Cuts bodies whose energies are not known into tasks of about as many springs each, or fewer.
  std::vector<Rows> tasks_of(const Model& model) const {
    std::vector<Rows> tasks;
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      const ModelBody& body = model.bodies[b];
      if (body.is_rigid() || is_clustered(model, b) || is_known_[b]) continue;
      const std::uint32_t end = body.first_vertex + body.vertex_count;
      for (std::uint32_t first = body.first_vertex; first < end; first = tasks.back().end)
        tasks.push_back({first, first + std::min(end - first, springs_of_task / (end - first) + 1)});
    }
    return tasks;
  }

  // Vertices that a stop leaves out have NaN.
  void sum_rows(const Model& model, const Rows& rows, bool is_stopped) {
    const ModelBody& body = model.body_of(rows.first);
    const SpringEnds ends{.rest = {rest_[0].data(), rest_[1].data(), rest_[2].data()},
                          .moved = {moved_[0].data(), moved_[1].data(), moved_[2].data()}};
    for (std::uint32_t i = rows.first; i < rows.end; ++i)
      energies_[i] = is_stopped ? std::numeric_limits<double>::quiet_NaN()
                                : 0.5 * body.stiffness * sum_of_springs_(ends, i, body.first_vertex + body.vertex_count);
  }

  // All of a clustered body's energy stands at its first vertex.
  void sum_clusters(const EnergyQuestion& question, std::size_t b) {
    const ModelBody& body = question.model.bodies[b];
    std::fill_n(energies_.begin() + body.first_vertex, body.vertex_count, 0.0);
    double& energy = energies_[body.first_vertex];
    energy = std::numeric_limits<double>::quiet_NaN();
    if (question.stopped && question.stopped()) return;
    if (!clustered_[b]) {
      const ListBasis basis = *list_basis_of(body, changed_sums_[b].get());
      clustered_[b].emplace(question.model.rest_positions_of(body), basis.accuracy, basis.displacements);
    }
    energy = body.stiffness * clustered_[b]->energy(question.pool, question.state.displacements_of(body));
  }

  ElongationSum sum_of_springs_;
  std::vector<double> rest_[3], moved_[3];                        // as SpringEnds has them
  std::vector<double> energies_;                                  // of each vertex's springs to later vertices of its body [J]
  std::vector<std::uint8_t> is_known_;                            // whether a body's energies are those of `moved_`
  std::vector<std::shared_ptr<const ChangedSums>> changed_sums_;  // by bodies, of the latest question
  std::vector<std::optional<ClusterSprings>> clustered_;          // by bodies
};

double spring_energy(const EnergyQuestion& question) {
  auto* energies = std::any_cast<SpringEnergies>(&question.kept);
  if (energies == nullptr) energies = &question.kept.emplace<SpringEnergies>(question.model);
  return energies->sum(question);
}

double spring_energy_scale(const ModelBody& body) { return 0.5 * body.stiffness * body.radius * body.radius; }
double spring_frequency_squared(const ModelBody& body) { return body.vertex_count * body.stiffness / body.vertex_mass; }

}  // namespace

Force springs() {
  return {.name = "springs",
          .is_zero_at_rest = true,
          .acts_on = [](const ModelBody&) { return true; },
          .energy = spring_energy,
          .energy_scale = spring_energy_scale,
          .frequency_squared = spring_frequency_squared,
          .make = nullptr,
          .warnings = nullptr};
}

}  // namespace pliant
