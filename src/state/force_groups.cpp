#include "state/force_groups.hpp"

#include <algorithm>

namespace pliant {
namespace {

std::uint32_t share_count(std::uint32_t vertex_count, std::uint32_t share_size) { return (vertex_count - 1) / share_size + 1; }

std::uint32_t vertices_of(std::span<const BodyToShare> bodies, bool BodyToShare::*counted) {
  std::uint32_t count = 0;
  for (const BodyToShare& body : bodies)
    if (body.*counted) count += body.vertex_count;
  return count;
}

std::uint32_t largest_soft_body_of(std::span<const BodyToShare> bodies) {
  std::uint32_t largest = 1;
  for (const BodyToShare& body : bodies)
    if (body.is_soft) largest = std::max(largest, body.vertex_count);
  return largest;
}

// Where more lanes are faster, a thread that adds up all springs of a vertex holds up each stage. Quiet steps by those are faster
// then, if there can be any.
bool holds_up_stages(const ForceVariant& variant) { return variant.lanes == 1 && variant.quiet_groups > 0; }

}  // namespace

// Bodies of several shares wait for each other between stages, so that all shares have to run at once, and nothing beside them.
// In quiet steps only those of bodies that move have to.
std::vector<ForceGroup> force_groups(const ForceAbilities& device, std::span<const BodyToShare> bodies,
                                     std::span<const std::size_t> variants_of_bodies) {
  std::vector<ForceGroup> groups;
  std::uint32_t first_share = 0;
  for (std::size_t variant = 0; variant < device.variants.size(); ++variant) {
    const ForceVariant& lanes = device.variants[variant];
    std::uint32_t count = 0, most_of_body = 0, of_moving_bodies = 0;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (!bodies[b].is_soft || variants_of_bodies[b] != variant) continue;
      const std::uint32_t of_body = share_count(bodies[b].vertex_count, lanes.share_size);
      count += of_body;
      most_of_body = std::max(most_of_body, of_body);
      if (bodies[b].moves) of_moving_bodies += of_body;
    }
    const bool are_whole = most_of_body == 1;
    const bool is_quiet = are_whole ? lanes.quiet_groups > 0 : std::max(most_of_body, of_moving_bodies) <= lanes.quiet_groups;
    if (count > 0) groups.push_back({variant, first_share, count, lanes.all_stages && are_whole, are_whole, is_quiet});
    first_share += count;
  }
  if (groups.size() == 1 && groups[0].share_count <= device.shares_at_once)
    groups[0].all_stages = device.variants[groups[0].variant].all_stages;
  return groups;
}

// Running all stages at once saves more than the best lanes do, where dispatches take time. Then all bodies have one variant. The
// same holds for quiet steps of the bodies that move, while others rest. Otherwise a stage starts work groups for all soft
// bodies, of which those at rest end at once, so the vertices of all count.
std::vector<std::size_t> best_force_variants(const ForceAbilities& device, std::span<const BodyToShare> bodies) {
  const std::uint32_t largest = largest_soft_body_of(bodies);
  const std::size_t fastest = best_force_variant(device.variants, vertices_of(bodies, &BodyToShare::moves), largest);
  for (bool ForceGroup::*in_one_dispatch : {&ForceGroup::all_stages, &ForceGroup::quiet_steps})
    for (std::size_t variant = fastest; variant < device.variants.size(); ++variant) {
      const ForceVariant& lanes = device.variants[variant];
      if (!lanes.suits(largest)) continue;
      if (in_one_dispatch == &ForceGroup::all_stages && variant != fastest && holds_up_stages(lanes)) continue;
      std::vector<std::size_t> same(bodies.size(), variant);
      const std::vector<ForceGroup> groups = force_groups(device, bodies, same);
      if (groups.size() == 1 && groups[0].*in_one_dispatch) return same;
    }
  std::vector<std::size_t> variants;
  const std::uint32_t soft_vertices = vertices_of(bodies, &BodyToShare::is_soft);
  for (const BodyToShare& body : bodies)
    variants.push_back(best_force_variant(device.variants, soft_vertices, body.vertex_count));
  return variants;
}

}  // namespace pliant
