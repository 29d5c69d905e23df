#include "dynamics/forces/force.hpp"

#include <algorithm>

#include "dynamics/forces/pressure.hpp"
#include "dynamics/forces/springs.hpp"

namespace pliant {
namespace {

std::vector<Force>& rows() {
  static std::vector<Force> all = {springs(), pressure()};
  return all;
}

bool acts_on_any(const Force& force, const Model& model) { return std::ranges::any_of(model.bodies, force.acts_on); }

void count_as_deformed(DeviceBodies& bodies, const Force& force, const Model& model) {
  std::vector<physics::Status> statuses = bodies.statuses.download();
  for (std::size_t b = 0; b < statuses.size(); ++b)
    if (!force.is_zero_at_rest && force.acts_on(model.bodies[b])) statuses[b].deformed = 1;
  bodies.statuses.upload(statuses);
}

}  // namespace

std::span<const Force> forces() { return rows(); }

void add_force(const Force& force) { rows().push_back(force); }

AddedForces::AddedForces(DeviceBodies& bodies, const Model& model) {
  for (const Force& force : forces()) {
    if (force.make == nullptr || !acts_on_any(force, model)) continue;
    forces_.push_back(force.make(bodies, model));
    count_as_deformed(bodies, force, model);
  }
}

std::vector<Pass> AddedForces::passes(std::uint32_t slot) const {
  std::vector<Pass> all;
  for (std::size_t k = 0; k < forces_.size(); ++k)
    for (Pass& pass : forces_[k]->passes(slot, k == 0)) all.push_back(std::move(pass));
  return all;
}

}  // namespace pliant
