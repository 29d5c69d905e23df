// Says how two bodies that intersect lie in each other. It is for messages: it takes a while for large meshes.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "model/model.hpp"
#include "scene/scene_description.hpp"

namespace pliant {

/// Two bodies that intersect.
struct Overlap {
  std::uint32_t first = 0, second = 0;
  double depth = 0;         // from a vertex of one to the surface of the other that it is inside, at least [m]; 0: none is inside
  glm::dvec3 way_out{0.0};  // moving the second body this way parts them, by their gap [m]
};

/// Returns the distance that contacts by impulses keep between two bodies [m].
[[nodiscard]] double gap_between(const Model& model, const ModelBody& a, const ModelBody& b,
                                 const CollisionDescription& collision);

/// Returns the two of these bodies that lie deepest in each other, as far as it can tell, or nothing if no two intersect.
/// `positions` are those of the model's vertices in the world [m].
[[nodiscard]] std::optional<Overlap> find_overlap(const Model& model, std::span<const glm::dvec3> positions,
                                                  std::span<const std::uint32_t> bodies, const CollisionDescription& collision);

}  // namespace pliant
