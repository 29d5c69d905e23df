// The path of a scripted body: its keys as a device follows them.
#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "physics/path.glsl"
#include "scene/scene_description.hpp"

namespace pliant {

struct BodyPath {
  std::vector<physics::PathKey> keys;  // two or more, by time
  physics::Path way{};                 // its `first_key` counts from the first of these

  /// Returns where the path leads at a time on its own clock [s].
  [[nodiscard]] physics::PathPoint at(double time) const;
  /// Return the fastest spin [rad/s] and the highest speed of the centre [m/s] at keys and half-way between them.
  [[nodiscard]] double fastest_spin() const;
  [[nodiscard]] double highest_speed() const;
};

/// Returns Rz Ry Rx for angles in degrees about fixed axes.
[[nodiscard]] glm::dquat rotation_of(const glm::dvec3& degrees);

/// Returns angles in degrees of which rotation_of makes the rotation.
[[nodiscard]] glm::dvec3 degrees_of(const glm::dquat& rotation);

/// Returns the keys of what is left of a body's path at a time on its own clock [s]. Their times count from there. One that
/// repeats goes around once. If the path has ended, there is one key, at its end. Between keys the way differs a little, because
/// a path that does not repeat begins at rest.
[[nodiscard]] std::vector<PathKeyDescription> path_from(const BodyDescription& description, double time);

/// Returns as many keys as the path has. They lead from where the body is now to another place of its centre [m], which it
/// reaches after so long [s], and let it rest there. Expects a path with keys that does not repeat, and a positive time.
[[nodiscard]] std::vector<physics::PathKey> keys_toward(const BodyPath& path, const physics::PathState& now,
                                                        const glm::dvec3& centre, double seconds);

/// Returns the path of a scripted body. `centroid` is the mean of its vertices before it is turned and moved [m].
///
/// Positions and the three angles of keys are interpolated by monotone cubics, so that nothing overshoots a key, and a body that
/// has equal keys rests between them. A path that does not repeat begins and ends at rest. Source: F. N. Fritsch and J. Butland,
/// "A method for constructing local monotone piecewise cubic interpolants" (1984).
///
/// A body without keys keeps its velocity, and its spin about `centroid`. Rotations are off by some 1e-5 rad between keys, and by
/// 1e-6 of a constant spin. Throws Error (input) if the path has over 100,000 keys or 15 degrees of turning together.
[[nodiscard]] BodyPath make_path(const BodyDescription& description, const glm::dvec3& centroid);

}  // namespace pliant
