#include "device/gpu/lanes.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace pliant::gpu {
namespace {

constexpr std::uint32_t any_number = ForceVariant::any_number;

// The first is for processors that run shaders. The others were measured on an H200:
// - Few vertices need many lanes each.
// - With many vertices, a lane serves several of them with what it loads.
// - Small groups do worse. The compiler then takes so many registers per thread that few threads fit.
// The second is for small bodies as long as each has a multiprocessor to itself, and waits for no other group.
// The fourth is only for all stages at once, or for quiet steps, where every group has a multiprocessor to itself.
// The sixth has a thread for each vertex of small bodies, where many lanes mostly idle. With many vertices it is the best for
// bodies of up to 256 vertices, too, which share a dispatch with smaller ones. So the fifth is for bodies of which the sixth has
// several shares.
constexpr Lanes choices[] = {
    {1, 4, 64, 2, 2, 64, 0, 1, any_number},          {8, 1, 48, 3, 6, 48, 6000, 1, 48},
    {64, 1, 10, 4, 4, 768, 2600, 1, any_number},     {64, 2, 10, 4, 8, 512, 0, 1, any_number},
    {32, 2, 20, 4, 20, 640, 8000, 65, any_number},   {1, 1, 64, 2, 2, 64, any_number, 1, 256},
    {64, 4, 8, 3, 18, 0, any_number, 1, any_number},
};

// A multiprocessor runs one large group. Of small ones an H100 runs four on each, and not eight.
std::uint32_t quiet_groups(const Lanes& lanes, bool is_software, std::uint32_t multiprocessors) {
  if (lanes.tile == 0) return 0;
  if (is_software) return 1;
  return multiprocessors * std::max(256u / lanes.threads(), 1u);
}

}  // namespace

std::span<const Lanes> lane_choices() { return choices; }

std::vector<ForceVariant> force_variants(bool is_software, std::uint32_t multiprocessors) {
  std::vector<ForceVariant> variants;
  for (const Lanes& choice : choices)
    variants.push_back({.name = fmt::format("{} x {} lanes, {} {}", choice.teams, choice.lanes, choice.vertices,
                                            choice.vertices == 1 ? "vertex" : "vertices"),
                        .share_size = choice.teams * choice.vertices,
                        .all_stages = choice.tile != 0,
                        .quiet_groups = quiet_groups(choice, is_software, multiprocessors),
                        .lanes = choice.lanes,
                        .most_vertices = is_software ? 0 : choice.most_vertices,
                        .smallest_body = choice.smallest_body,
                        .largest_body = choice.largest_body});
  if (is_software) variants[0].most_vertices = any_number;
  return variants;
}

}  // namespace pliant::gpu
