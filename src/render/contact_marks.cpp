#include "render/contact_marks.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

namespace pliant::render {
namespace {

constexpr glm::vec4 contact_color(1.0f, 0.2f, 0.3f, 1.0f), impulse_color(0.1f, 0.1f, 0.12f, 1.0f);

void add_cross(Lines& lines, const glm::dvec3& at, double arm) {
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 along(0.0);
    along[axis] = arm;
    add_line(lines, at - along, at + along, contact_color);
  }
}

double smallest_radius(const Model& model) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const ModelBody& body : model.bodies)
    if (!body.is_rigid()) smallest = std::min(smallest, body.radius);
  return smallest;
}

// Where the contact is on its first body, which has weights above 0, or on its second one.
glm::dvec3 place_of(const ContactImpulse& contact, std::span<const glm::dvec3> positions, bool on_second) {
  glm::dvec3 place(0.0);
  for (int k = 0; k < 4; ++k) {
    const double weight = on_second ? -contact.weight[k] : contact.weight[k];
    if (contact.vertex[k] != physics::no_vertex && weight > 0) place += weight * positions[contact.vertex[k]];
  }
  return place;
}

// A vertex of the first body or of the second one. A ground has none.
std::uint32_t vertex_of(const ContactImpulse& contact, bool of_second) {
  for (int k = 0; k < 4; ++k)
    if (contact.vertex[k] != physics::no_vertex && (of_second ? contact.weight[k] < 0 : contact.weight[k] > 0))
      return contact.vertex[k];
  return physics::no_vertex;
}

}  // namespace

void add_line(Lines& lines, const glm::dvec3& from, const glm::dvec3& to, const glm::vec4& color) {
  lines.push_back({glm::vec4(from, 1.0), color});
  lines.push_back({glm::vec4(to, 1.0), color});
}

void add_touching(Lines& lines, const Model& model, std::span<const glm::dvec3> positions,
                  std::span<const std::uint32_t> touching) {
  for (const std::uint32_t vertex : touching) add_cross(lines, positions[vertex], 0.05 * model.body_of(vertex).radius);
}

void add_impulses(Lines& lines, const Model& model, std::span<const glm::dvec3> positions,
                  std::span<const ContactImpulse> contacts) {
  double largest = 0;
  for (const ContactImpulse& contact : contacts) largest = std::max(largest, glm::length(contact.impulse));
  if (!(largest > 0)) return;
  const double radius = smallest_radius(model), metres_per_impulse = 0.5 * radius / largest;
  for (const ContactImpulse& contact : contacts) {
    add_cross(lines, place_of(contact, positions, false), 0.02 * radius);
    for (const bool on_second : {false, true}) {
      const std::uint32_t vertex = vertex_of(contact, on_second);
      if (vertex == physics::no_vertex || model.body_of(vertex).is_rigid()) continue;
      const glm::dvec3 place = place_of(contact, positions, on_second);
      add_line(lines, place, place + (on_second ? -metres_per_impulse : metres_per_impulse) * contact.impulse, impulse_color);
    }
  }
}

void add_contacts(Lines& lines, Simulation& simulation, const Model& model, std::span<const glm::dvec3> positions) {
  if (simulation.collider().response_row().gives_impulses)
    add_impulses(lines, model, positions, simulation.contact_impulses());
  else
    add_touching(lines, model, positions, simulation.touching_vertices());
}

}  // namespace pliant::render
