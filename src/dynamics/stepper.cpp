// A step of a Runge-Kutta method is a dispatch a stage; of a splitting, a dispatch a force.
#include "dynamics/stepper.hpp"

#include <cstddef>

#include "core/expect.hpp"
#include "physics/damping.glsl"

namespace pliant {
namespace {

using physics::Control;

static_assert(static_cast<std::uint32_t>(DampingLaw::none) == physics::damping_none);
static_assert(static_cast<std::uint32_t>(DampingLaw::constant) == physics::damping_constant);
static_assert(static_cast<std::uint32_t>(DampingLaw::adaptive) == physics::damping_adaptive);

// The rows that runge_kutta_stage.glsl reads: c, then position and velocity weights in turn.
std::vector<double> interleaved(const NystromTableau& tableau) {
  std::vector<double> rows;
  const auto stages = static_cast<std::size_t>(tableau.stages);
  for (std::size_t row = 0; row <= stages; ++row) {
    rows.push_back(tableau.c[row]);
    for (std::size_t j = 0; j < stages; ++j) {
      rows.push_back(tableau.position[row * stages + j]);
      rows.push_back(tableau.velocity[row * stages + j]);
    }
  }
  return rows;
}

}  // namespace

Stepper::Stepper(Device& device, DeviceBodies& bodies, const Integrator& integrator, DampingLaw law, double time_step)
    : device_(device), bodies_(bodies), integrator_(integrator), law_(static_cast<std::uint32_t>(law)), time_step_(time_step) {
  PLIANT_EXPECT(law == DampingLaw::none || allows_damping(integrator));
  const std::size_t count = bodies.vertex_count;
  const std::size_t words_of_real4 = static_cast<std::size_t>(device.precision()) / 8;
  stages_ = DeviceArray<std::uint32_t>(device, 2 * count * words_of_real4, "stage displacements");
  forces_ = DeviceArray<std::uint32_t>(device, count * words_of_real4, "spring forces");
  if (const auto* method = std::get_if<RungeKutta>(&integrator.method)) {
    const NystromTableau tableau = nystrom_tableau(*method);
    PLIANT_EXPECT(tableau.c.front() == 0);  // the first stage is the step's start
    stage_count_ = static_cast<std::uint32_t>(tableau.stages);
    tableau_ = DeviceArray<double>(device, interleaved(tableau), "tableau");
    accelerations_ = DeviceArray<double>(device, 3 * count * stage_count_, "accelerations");
  } else {
    stage_count_ = static_cast<std::uint32_t>(std::get<Splitting>(integrator.method).drift.size());
    accelerations_ = DeviceArray<double>(device, 0, "accelerations");
  }
}

std::vector<Pass> Stepper::passes(std::uint32_t from_half) const {
  std::vector<Pass> result = opening_passes(from_half);
  const auto* splitting = std::get_if<Splitting>(&integrator_.method);
  const auto rest = splitting != nullptr ? splitting_passes(*splitting, from_half) : runge_kutta_passes(from_half);
  result.insert(result.end(), rest.begin(), rest.end());
  return result;
}

std::vector<Pass> Stepper::opening_passes(std::uint32_t from_half) const {
  const DeviceBodies& b = bodies_;
  const std::uint32_t keep_velocity = law_ != physics::damping_none && tableau_.size() > 0 ? 1 : 0;
  return {make_pass(device_, "begin_bodies",
                    {b.control.id(), b.bodies.id(), b.frames.id(), b.rest_positions.id(), b.motions.id(), b.body_boxes.id()},
                    {b.vertex_count, from_half}, b.body_count),
          make_indirect_pass(device_, "change_frame", {b.frames.id(), b.rest_positions.id(), b.motions.id(), forces_.id()},
                             {b.vertex_count, from_half}, b.control.id(), offsetof(Control, turn_groups)),
          make_pass(device_, "round_displacement",
                    {b.bodies.id(), b.frames.id(), b.rest_positions.id(), b.motions.id(), stages_.id(), accelerations_.id()},
                    {b.vertex_count, from_half, keep_velocity}, b.vertex_count)};
}

std::vector<Pass> Stepper::runge_kutta_passes(std::uint32_t from_half) const {
  const DeviceBodies& b = bodies_;
  std::vector<Pass> result;
  for (std::uint32_t stage = 0; stage < stage_count_; ++stage)
    result.push_back(make_pass(device_, "runge_kutta_stage",
                               {b.bodies.id(), b.frames.id(), b.rest_positions.id(), stages_.id(), accelerations_.id(),
                                b.motions.id(), b.world_positions.id(), tableau_.id()},
                               {b.vertex_count, from_half, law_, stage, stage_count_, time_step_}, b.vertex_count));
  return result;
}

std::vector<Pass> Stepper::splitting_passes(const Splitting& method, std::uint32_t from_half) const {
  const DeviceBodies& b = bodies_;
  const auto seconds = [&](long double fraction) { return static_cast<double>(fraction * static_cast<long double>(time_step_)); };
  std::vector<Pass> result = {
      make_indirect_pass(device_, "refresh_force",
                         {b.bodies.id(), b.frames.id(), b.rest_positions.id(), stages_.id(), forces_.id()}, {b.vertex_count},
                         b.control.id(), offsetof(Control, refresh_groups)),
      make_pass(device_, "first_kick",
                {b.bodies.id(), b.frames.id(), b.rest_positions.id(), stages_.id(), forces_.id(), b.motions.id()},
                {b.vertex_count, from_half, law_, seconds(method.kick[0]), seconds(method.drift[0])}, b.vertex_count)};
  long double elapsed = method.drift[0];
  for (std::uint32_t stage = 0; stage < stage_count_; ++stage) {
    const long double drift = stage + 1 < stage_count_ ? method.drift[stage + 1] : 0;
    elapsed += drift;
    result.push_back(make_pass(
        device_, "splitting_stage",
        {b.bodies.id(), b.frames.id(), b.rest_positions.id(), stages_.id(), forces_.id(), b.motions.id(), b.world_positions.id()},
        {b.vertex_count, from_half, law_, seconds(method.kick[stage + 1]), seconds(drift), seconds(elapsed), stage},
        b.vertex_count));
  }
  return result;
}

}  // namespace pliant
