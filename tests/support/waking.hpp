// Looks whether every body wakes that should. A window is some steps, too few to fall asleep in. It is made with sleep, and again
// from the same bytes with every body awake.
#pragma once
#include <cstdint>
#include <glm/vec4.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "collision/responses/response.hpp"
#include "model/model.hpp"
#include "physics/body.glsl"

namespace pliant::test {

/// Returns what Simulation::save has of the bodies' statuses. One more stands for all bodies.
[[nodiscard]] std::vector<physics::Status> saved_statuses(std::string_view saved, const Model& model);

/// Returns the same bytes with all bodies awake. None falls asleep in the next half second.
[[nodiscard]] std::string with_all_awake(std::string saved, const Model& model);

/// What was seen of one window. Positions are those of all vertices in the world [m].
struct Window {
  std::vector<physics::Status> before, after;  // of the bodies
  std::vector<glm::vec4> start;
  std::vector<glm::vec4> last_start;        // where its last step began
  std::vector<ContactImpulse> impulses;     // of its last step
  std::vector<glm::vec4> awake;             // its end, if nobody sleeps
  std::vector<glm::vec4> awake_and_let_be;  // its end, if nobody sleeps or is pulled. Empty: nobody was pulled
  std::vector<std::uint32_t> pulled;        // bodies

  [[nodiscard]] bool slept_through(std::uint32_t b) const { return before[b].asleep != 0 && after[b].asleep != 0; }
  [[nodiscard]] std::uint64_t sleepers() const;  // that slept through
  [[nodiscard]] std::uint64_t woken() const;
};

/// How far a body may go that rests [m].
struct Stillness {
  double in_half_a_second = 0;  // of two places within sleep_way() of where the slow time began, how far they may be apart
  double by_a_pull = 0;         // of other bodies, in a window
};
/// `gravity` is the size of the acceleration [m/s^2].
[[nodiscard]] Stillness stillness_of(const Model& model, double gravity);

/// Returns the farthest that vertices of bodies went which slept through the window, in the senses of Stillness [m].
[[nodiscard]] Stillness farthest_of_sleepers(const Window& window, const Model& model);

/// Returns a sentence for each breach of these laws:
/// - Who is pulled is awake.
/// - Whoever slept through the window rests without sleep, too. With all awake it stays within Stillness::in_half_a_second.
/// - A pull does not move it. With all awake it ends where it would without the pull, within Stillness::by_a_pull.
/// - No contact gave it an impulse in the last step.
/// - No body that is awake was within an edge of it when the last step began, as boxes along the axes.
[[nodiscard]] std::vector<std::string> breaches(const Window& window, const Model& model, const Stillness& stillness);

}  // namespace pliant::test
