#include "device/gpu/lanes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/expect.hpp"

namespace pliant::gpu {
namespace {

constexpr std::uint32_t any_number = ForceVariant::any_number;

// A way to share springs, and the scenes for which it is the fastest, as ForceVariant has them.
struct Choice {
  Lanes lanes;
  std::uint32_t most_vertices = 0, smallest_body = 1, largest_body = any_number;
};

// All but the first were measured on an H200:
// - Few vertices need many lanes each.
// - With many vertices, a lane serves several of them with what it loads.
// - Small groups do worse. The compiler then takes so many registers per thread that few threads fit.
constexpr Choice choices[] = {
    // For processors that run shaders.
    {.lanes = {.lanes = 1, .vertices = 4, .teams = 64, .unroll = 2, .plainly = 2, .tile = 64}},
    // For small bodies as long as each has a multiprocessor to itself. None has to wait for another group.
    {.lanes = {.lanes = 8, .vertices = 1, .teams = 48, .unroll = 3, .plainly = 6, .tile = 48},
     .most_vertices = 6000,
     .largest_body = 48},
    {.lanes = {.lanes = 64, .vertices = 1, .teams = 10, .unroll = 4, .plainly = 4, .tile = 768}, .most_vertices = 2600},
    // Only for all stages or quiet steps in one dispatch, where every group has a multiprocessor to itself.
    {.lanes = {.lanes = 64, .vertices = 2, .teams = 10, .unroll = 4, .plainly = 8, .tile = 512}, .most_vertices = 0},
    // For bodies that have several shares by the next one.
    {.lanes = {.lanes = 32, .vertices = 2, .teams = 20, .unroll = 4, .plainly = 20, .tile = 640},
     .most_vertices = 8000,
     .smallest_body = 65},
    // In small bodies many lanes mostly idle. With many vertices this serves larger bodies best, too, in one dispatch with small
    // ones.
    {.lanes = {.lanes = 1, .vertices = 1, .teams = 64, .unroll = 2, .plainly = 2, .tile = 64},
     .most_vertices = any_number,
     .largest_body = 256},
    {.lanes = {.lanes = 64, .vertices = 4, .teams = 8, .unroll = 3, .plainly = 18, .tile = 0}, .most_vertices = any_number},
};

constexpr Lanes for_given_sums = {.lanes = 0, .vertices = 1, .teams = 64, .unroll = 0, .plainly = 0, .tile = 0};

// A multiprocessor runs one large group. Of small ones an H100 runs four on each, and not eight.
std::uint32_t quiet_groups(const Lanes& lanes, const Processors& gpu) {
  if (lanes.tile == 0) return 0;
  if (gpu.are_software) return 1;
  return gpu.multiprocessors * std::max(256u / lanes.threads(), 1u);
}

}  // namespace

std::vector<ForceVariant> force_variants(const Processors& gpu) {
  std::vector<ForceVariant> variants;
  for (const Choice& choice : choices)
    variants.push_back({.name = fmt::format("{} x {} lanes, {} {}", choice.lanes.teams, choice.lanes.lanes, choice.lanes.vertices,
                                            choice.lanes.vertices == 1 ? "vertex" : "vertices"),
                        .share_size = choice.lanes.teams * choice.lanes.vertices,
                        .all_stages = choice.lanes.tile != 0,
                        .quiet_groups = quiet_groups(choice.lanes, gpu),
                        .lanes = choice.lanes.lanes,
                        .cancels_rounding = choice.lanes.cancels_rounding(),
                        .most_vertices = choice.most_vertices,
                        .smallest_body = choice.smallest_body,
                        .largest_body = choice.largest_body});
  if (gpu.are_software) variants[0].most_vertices = any_number;
  return variants;
}

ForceVariant variant_for_given_sums() {
  return {.name = "given sums", .share_size = for_given_sums.teams * for_given_sums.vertices, .lanes = 0};
}

const Lanes& lanes_of(std::size_t variant) {
  PLIANT_EXPECT(variant <= std::size(choices));
  return variant == std::size(choices) ? for_given_sums : choices[variant].lanes;
}

}  // namespace pliant::gpu
