#include "bench/collision/contact_step.hpp"

#include <map>

#include "bench/collision/spheres.hpp"
#include "bench/common/timing.hpp"
#include "dynamics/integrator.hpp"
#include "dynamics/stability.hpp"
#include "simulation/breakdown.hpp"
#include "simulation/simulation.hpp"

namespace pliant::bench {
namespace {

constexpr std::size_t all_parts = 15, fewest_parts = 3;
constexpr double enough_seconds = 10;  // once they have passed, the fewest are enough
constexpr double omega_step = 0.05;    // so short that spheres still press each other in the last part

class PressedSpheres {
 public:
  PressedSpheres(const Place& place, int level)
      : place_(place),
        device_(open(place)),
        start_(pressed_spheres(level)),
        plan_{.integrator = &find_integrator("verlet"),
              .time_step = omega_step / stiffest_frequency(start_.model.bodies.front())},
        simulation_(*device_, start_.model, start_.state, plan_, {.response = {"impulse"}}) {
    simulation_.time_passes();
  }

  ContactStepRow make_part() {
    std::map<std::string_view, double> seconds = simulation_.pass_seconds();
    for (auto& [pass, taken] : seconds) taken = -taken;
    simulation_.advance_part();
    ContactStepRow row{
        .device = place_.device, .threads = place_.threads, .triangles = start_.model.bodies.front().triangle_count};
    for (const auto& [pass, taken] : simulation_.pass_seconds()) row.step_seconds += seconds[pass] += taken;
    for (const PassGroup& group : contact_groups()) {
      double& sum = row.seconds.emplace_back(group.name, 0).second;
      for (const std::string_view pass : group.passes) sum += seconds[pass];
    }
    row.pressing_contacts = simulation_.contact_impulses().size();
    return row;
  }

  [[nodiscard]] std::string breakdown() {
    const std::optional<Breakdown> where = simulation_.report().breakdown;
    return where ? describe_breakdown(*where, plan_, start_.model) : "";
  }

 private:
  Place place_;
  std::unique_ptr<Device> device_;
  ModelAndState start_;
  TimePlan plan_;
  Simulation simulation_;
};

// Returns the last part with the medians of all parts.
ContactStepRow medians_of(const std::vector<ContactStepRow>& parts) {
  const auto median_of = [&](const auto& figure) {
    std::vector<double> figures;
    for (const ContactStepRow& part : parts) figures.push_back(figure(part));
    return median(std::move(figures));
  };
  ContactStepRow row = parts.back();
  for (std::size_t k = 0; k < row.seconds.size(); ++k)
    row.seconds[k].second = median_of([k](const ContactStepRow& part) { return part.seconds[k].second; });
  row.step_seconds = median_of([](const ContactStepRow& part) { return part.step_seconds; });
  return row;
}

}  // namespace

std::span<const PassGroup> contact_groups() {
  static const std::vector<PassGroup> groups = {
      {"expectation", {"measure_motion", "limit_step", "find_flights", "expect_motion"}},
      {"refit", {"bound_cage_treelets", "pair_treelets", "refit_cages"}},
      {"search", {"pair_bodies", "find_pairs", "list_triangle_pairs", "list_unlisted_pairs"}},
      {"contacts", {"find_contacts"}},
      {"impulses", {"keep_impulses", "take_up_impulses", "solve_contacts"}},
      {"certificate", {"expect_cuts", "certify", "settle", "pay_dues"}}};
  return groups;
}

ContactStepRow measure_contact_step(const Place& place, int level, bool quick) {
  PressedSpheres spheres(place, level);
  (void)spheres.make_part();  // builds the kernels
  const std::size_t most_parts = quick ? fewest_parts : all_parts;
  std::vector<ContactStepRow> parts;
  for (double passed = 0; parts.size() < fewest_parts || (parts.size() < most_parts && passed < enough_seconds);)
    passed += parts.emplace_back(spheres.make_part()).step_seconds;
  ContactStepRow row = medians_of(parts);
  row.breakdown = spheres.breakdown();
  return row;
}

}  // namespace pliant::bench
