// How bodies answer contacts. A response is one file and one row in a list.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "collision/broad_phase/body_pairs.hpp"
#include "collision/responses/scripted_bodies.hpp"
#include "collision/trees/tree_search.hpp"
#include "device/pass.hpp"
#include "scene/scene_description.hpp"
#include "state/device_bodies.hpp"

namespace pliant {

/// What a response did since the start.
struct ResponseReport {
  glm::dvec3 outside_impulse{0.0};  // that static and scripted bodies and grounds gave [Ns]
  // Energy in motion that contacts gave and took [J]. An impulse gives p . (v + v') / 2, with the velocities before and after.
  double energy_given = 0, energy_taken = 0;
  double friction_work = 0;                // what friction took of both [J]
  double work_of_scripts = 0;              // what scripted bodies gave by moving [J]
  std::vector<ScriptReport> scripts = {};  // of each scripted body

  bool operator==(const ResponseReport&) const = default;
};

/// An impulse that a contact gave in the latest step. A contact lies between four vertices of two bodies, or between one vertex
/// and a ground. Missing vertices are physics::no_vertex.
struct ContactImpulse {
  glm::uvec4 vertex{0};
  glm::dvec4 weight{0.0};   // of the vertices, above 0 on the first body and below 0 on the second
  glm::dvec3 impulse{0.0};  // on the first body, in the world [Ns]
};

/// Records the passes of one response. Each response decides what a contact holds: it makes the arrays for that, or uses the
/// marks of touching vertices. No result may depend on the order in which contacts were found.
class Response {
 public:
  virtual ~Response() = default;
  /// Returns passes that run before the step's stages, with the state in this half.
  [[nodiscard]] virtual std::vector<Pass> before_step(std::uint32_t /*from_half*/) const { return {}; }
  /// Returns how steps have fallen into parts, or null if the response never divides one.
  [[nodiscard]] virtual const DeviceArray<physics::StepParts>* step_parts() const { return nullptr; }
  /// Waits for the queued steps.
  [[nodiscard]] virtual ResponseReport report() const { return {}; }
  /// Returns as bytes what the next step has from the contacts of this one, beside carried arrays. Bytes do not depend on the
  /// device or its precision. Waits for the queued steps.
  [[nodiscard]] virtual std::string save() const { return {}; }
  /// Goes on from these bytes.
  virtual void restore(std::string_view /*saved*/) {}
  /// Returns the impulses of the latest step, in no fixed order, without those that are zero. There are none if the row's
  /// `gives_impulses` is false. Waits for the queued steps. Nothing is read back without this call.
  [[nodiscard]] virtual std::vector<ContactImpulse> contact_impulses() const { return {}; }
  /// Returns passes that find for how many steps nothing can happen that the response answers (physics/quiet.glsl), with the
  /// state in this half. The others follow such steps. Responses to touching triangles need none (kernels/give_room.glsl).
  [[nodiscard]] virtual std::vector<Pass> before_quiet_steps(std::uint32_t /*from_half*/) const { return {}; }
  [[nodiscard]] virtual std::vector<Pass> after_quiet_steps() const { return {}; }
  /// Returns passes that run after the search for touching triangles, with the state in the other half. If a tolerance governs
  /// steps, they run after the verdict.
  [[nodiscard]] virtual std::vector<Pass> after_step(std::uint32_t from_half) const = 0;
};

/// What a response knows of the method that makes steps.
struct StepTraits {
  bool vary_in_length = false;                // as a tolerance demands
  bool have_forces_at_ends = false;           // forces act at the ends of a step alone
  DampingLaw damping_law = DampingLaw::none;  // its rate bounds steps of bodies in contact
};

/// What a response is made for. All but the description must outlive it.
struct ResponseSetting {
  DeviceBodies& bodies;
  const Model& model;
  const CollisionDescription& description;
  const Forest& forest;
  const BodyPairs& body_pairs;
  const TreeSearch& trees;
  StepTraits steps;
  bool sleeps;  // whether bodies that rest on something stop to move
};

/// A response, and what others have to know of it. A row that says no more than these defaults is "none".
struct ResponseRow {
  std::string_view name = "none";  // the scene's `collision.response`
  /// Null if contacts are not answered.
  std::unique_ptr<Response> (*make)(const ResponseSetting& setting) = nullptr;
  double elasticity = 0.9;                             // of a scene that names none
  DampingLaw law_with_gravity = DampingLaw::adaptive;  // of a scene with gravity that names none
  bool allows_immovable = false;                       // static and scripted bodies, and grounds
  bool allows_brute_force = true;                      // as the scene's `collision.search`
  bool divides_steps = false;                          // of a fixed length: see step_parts()
  bool keeps_apart = false;      // bodies that are apart at the start stay so. Those that are not can't begin
  bool gives_impulses = false;   // contact_impulses() says what contacts gave
  bool reads_surfaces = false;   // friction, restitution and gap, and the elasticity of each body, change what it does
  bool answers_touching = true;  // after_step() answers triangles that touch at the step's end, so the step looks for them
  bool follows_frames = false;   // and restates what bodies have in frames that turned. Not if it lets bodies sleep
};

/// Returns all rows but "none".
[[nodiscard]] std::span<const ResponseRow> responses();
/// Adds another program's row. Scenes planned from then on may name it. Rows that others hold by reference are invalid then.
void add_response(const ResponseRow& row);
/// Throws Error that blames the name's origin if no row has the name.
[[nodiscard]] const ResponseRow& find_response(const Named& name);
/// Returns the scene's response. Throws Error if there is none of that name, or if it does not allow what the scene has.
[[nodiscard]] const ResponseRow& response_of(const SceneDescription& scene);
/// Returns the elasticity that a scene names, or the default of its response.
[[nodiscard]] double elasticity_of(const CollisionDescription& collision);

}  // namespace pliant
