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

void count_as_deformed(DeviceBodies& bodies, const Force& force, const Model& model) {
  std::vector<physics::Status> statuses = bodies.statuses.download();
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!force.is_zero_at_rest && feels(model.bodies[b], force)) statuses[b].deformed = 1;
  bodies.statuses.upload(statuses);
}

}  // namespace

bool feels(const ModelBody& body, const Force& force) { return !body.is_rigid() && force.acts_on(body); }

bool any_feels(const Model& model, const Force& force) {
  return std::ranges::any_of(model.bodies, [&](const ModelBody& body) { return feels(body, force); });
}

std::span<const Force> forces() { return rows(); }

void add_force(const Force& force) { rows().push_back(force); }

AddedForces::AddedForces(DeviceBodies& bodies, const Model& model) {
  for (const Force& force : forces()) {
    if (force.make == nullptr || !any_feels(model, force)) continue;
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
