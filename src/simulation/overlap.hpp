// Finds bodies that intersect, or that are nearer than proofs can tell, and says how two of them lie, by positions in fp64. It
// takes a while for large meshes that intersect.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "model/model.hpp"
#include "scene/scene_description.hpp"

namespace pliant {

/// Two bodies that intersect or are too near each other.
struct Overlap {
  std::uint32_t first = 0, second = 0;
  double depth = 0;         // from a vertex of one to the surface of the other that it is inside, at least [m]; 0: none is inside
  double distance = 0;      // of bodies that do not intersect [m]
  glm::dvec3 way_out{0.0};  // of bodies that do: moving the second this way parts them, by their gap [m]
};

/// Returns the distance that contacts by impulses keep between two bodies [m].
[[nodiscard]] double gap_between(const Model& model, const ModelBody& a, const ModelBody& b,
                                 const CollisionDescription& collision);

/// Returns two bodies that intersect, and of some such pairs the one that lies deepest in each other. If there is none, it
/// returns the two nearest ones that cannot be proven to be apart by numbers of this precision (32 or 64), or nothing. Looks at
/// no two static bodies. `positions` are those of the model's vertices in the world [m].
[[nodiscard]] std::optional<Overlap> find_overlap(const Model& model, std::span<const glm::dvec3> positions,
                                                  const CollisionDescription& collision, int precision);

/// Pairs of triangles of one body. Those that share a vertex count by what else of them touches, and those that share an edge not
/// at all.
struct OwnContacts {
  std::uint64_t touching = 0;  // or so near that fp64 cannot tell: some 1e-15 of their size
  std::uint64_t too_near = 0;  // to be proven apart by numbers of the precision asked for
};

/// `positions` are as above.
[[nodiscard]] OwnContacts own_contacts(const Model& model, const ModelBody& body, std::span<const glm::dvec3> positions,
                                       int precision);

/// Returns how many pairs of triangles of two bodies, or of one with self-contact, touch. Looks at no two static bodies.
/// `positions` are as above.
[[nodiscard]] std::uint64_t count_touching_pairs(const Model& model, std::span<const glm::dvec3> positions);

}  // namespace pliant
