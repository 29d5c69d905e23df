#include "state/force_groups.hpp"

#include <algorithm>

namespace pliant {
namespace {

std::uint32_t share_count(std::uint32_t vertex_count, std::uint32_t share_size) { return (vertex_count - 1) / share_size + 1; }

// Of bodies whose springs kernels sum themselves.
std::uint32_t vertices_of(std::span<const ForceBody> bodies, bool ForceBody::*counted) {
  std::uint32_t count = 0;
  for (const ForceBody& body : bodies)
    if (body.*counted && !body.has_given_sums) count += body.vertex_count;
  return count;
}

std::uint32_t largest_soft_body_of(std::span<const ForceBody> bodies) {
  std::uint32_t largest = 1;
  for (const ForceBody& body : bodies)
    if (body.is_soft) largest = std::max(largest, body.vertex_count);
  return largest;
}

// Where a thread adds up all springs of a vertex, and the shares of a body wait for each other, more lanes are faster, in quiet
// steps even more so. docs/benchmarks/2026-11-27-quiet-steps.md has the times.
bool has_slow_stages(const ForceVariant& variant, const ForceGroup& group) {
  return variant.lanes == 1 && !group.has_whole_bodies;
}

std::vector<std::size_t> fastest_for_each(const ForceAbilities& device, std::span<const ForceBody> bodies) {
  std::vector<std::size_t> variants;
  const std::uint32_t soft_vertices = vertices_of(bodies, &ForceBody::is_soft);
  for (const ForceBody& body : bodies)
    variants.push_back(body.has_given_sums ? device.variants.size()
                                           : fastest_force_variant(device.variants, soft_vertices, body.vertex_count));
  return variants;
}

}  // namespace

// Bodies of several shares wait for each other between stages, so that all shares have to run at once, and nothing beside them.
// In quiet steps only those of bodies that move have to. A body with more shares than that could never be quiet once it wakes. It
// would keep a variant that suits what moves before, which takes longer for large bodies.
std::vector<ForceGroup> group_shares(const ForceAbilities& device, std::span<const ForceBody> bodies,
                                     std::span<const std::size_t> variants_of_bodies) {
  std::vector<ForceGroup> groups;
  std::uint32_t first_share = 0;
  for (std::size_t v = 0; v <= device.variants.size(); ++v) {
    const ForceVariant& variant = device.variant(v);
    std::uint32_t count = 0, most_of_body = 0, of_moving_bodies = 0;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (!bodies[b].is_soft || variants_of_bodies[b] != v) continue;
      const std::uint32_t of_body = share_count(bodies[b].vertex_count, variant.share_size);
      count += of_body;
      most_of_body = std::max(most_of_body, of_body);
      if (bodies[b].moves) of_moving_bodies += of_body;
    }
    if (count == 0) continue;
    const bool are_whole = most_of_body == 1;
    const bool is_quiet =
        variant.quiet_groups > 0 && (are_whole || std::max(most_of_body, of_moving_bodies) <= variant.quiet_groups);
    groups.push_back({v, first_share, count, variant.all_stages && are_whole, are_whole, is_quiet});
    first_share += count;
  }
  if (groups.size() == 1 && groups[0].share_count <= device.shares_at_once)
    groups[0].all_stages = device.variant(groups[0].variant).all_stages;
  return groups;
}

// In quiet steps groups of bodies at rest do nothing, so the fastest is that for the bodies that move. Else a stage starts groups
// for all soft bodies, of which those at rest end at once, so the vertices of all count.
std::vector<std::size_t> choose_force_variants(const ForceAbilities& device, std::span<const ForceBody> bodies) {
  if (std::ranges::any_of(bodies, &ForceBody::has_given_sums)) return fastest_for_each(device, bodies);
  const std::uint32_t largest = largest_soft_body_of(bodies);
  const std::size_t fastest = fastest_force_variant(device.variants, vertices_of(bodies, &ForceBody::moves), largest);
  for (bool ForceGroup::*in_one_dispatch : {&ForceGroup::all_stages, &ForceGroup::quiet_steps})
    for (std::size_t v = fastest; v < device.variants.size(); ++v) {
      const ForceVariant& variant = device.variants[v];
      if (!variant.suits(largest)) continue;
      std::vector<std::size_t> same(bodies.size(), v);
      const std::vector<ForceGroup> groups = group_shares(device, bodies, same);
      if (groups.size() != 1 || !(groups[0].*in_one_dispatch)) continue;
      if (in_one_dispatch == &ForceGroup::all_stages && has_slow_stages(variant, groups[0])) continue;
      return same;
    }
  return fastest_for_each(device, bodies);
}

}  // namespace pliant
