#include "collision/trees/split.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <utility>

#include "core/expect.hpp"

namespace pliant {
namespace {

using Items = std::span<TreeItem>;

TreeBox bounds(std::span<const TreeItem> items) {
  TreeBox box;
  for (const TreeItem& item : items) box.add(item.box);
  return box;
}

int longest_axis(const glm::dvec3& extent) {
  if (extent.x >= extent.y && extent.x >= extent.z) return 0;
  return extent.y >= extent.z ? 1 : 2;
}

std::size_t split_at_centre(Items items) {
  const TreeBox box = bounds(items);
  const int axis = longest_axis(box.upper - box.lower);
  const double centre = 0.5 * (box.lower[axis] + box.upper[axis]);
  const auto right =
      std::stable_partition(items.begin(), items.end(), [&](const TreeItem& item) { return item.centroid[axis] < centre; });
  return static_cast<std::size_t>(right - items.begin());
}

// The first part fills whole leaves.
std::size_t middle_of(std::size_t count, unsigned leaf_size) {
  const std::size_t leaves = (count + leaf_size - 1) / leaf_size;
  return leaves / 2 * leaf_size;
}

void part_at(Items items, std::size_t middle, int axis) {
  const auto key = [axis](const TreeItem& item) { return std::pair(item.centroid[axis], item.triangle); };
  std::ranges::nth_element(items, items.begin() + static_cast<std::ptrdiff_t>(middle), {}, key);
}

bool has_one_centroid(std::span<const TreeItem> items) {
  return std::ranges::all_of(items, [&](const TreeItem& item) { return item.centroid == items.front().centroid; });
}

std::size_t split_at_median(Items items, unsigned leaf_size) {
  if (has_one_centroid(items)) return 0;
  const std::size_t middle = middle_of(items.size(), leaf_size);
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    part_at(items, middle, axis);
    const double surface = bounds(items.first(middle)).half_surface() + bounds(items.subspan(middle)).half_surface();
    if (surface < least) best = axis;
    least = std::min(least, surface);
  }
  part_at(items, middle, best);
  return middle;
}

constexpr int bin_count = 16;

struct Bin {
  TreeBox box;
  std::size_t count = 0;
};

// The bins' width is even between the centroids that are furthest apart on an axis.
int bin_of(double centroid, double lower, double upper) {
  return std::clamp(static_cast<int>(bin_count * (centroid - lower) / (upper - lower)), 0, bin_count - 1);
}

struct Place {
  double cost = std::numeric_limits<double>::infinity();
  int axis = 0, first_of_second = 0;  // bin
};

Place best_place(const std::array<Bin, bin_count>& bins, int axis) {
  std::array<Bin, bin_count> from;  // from each bin on
  for (int k = bin_count - 1; k >= 0; --k) {
    from[k] = bins[k];
    if (k + 1 == bin_count) continue;
    from[k].box.add(from[k + 1].box);
    from[k].count += from[k + 1].count;
  }
  Place best;
  Bin before;
  for (int k = 1; k < bin_count; ++k) {
    before.box.add(bins[k - 1].box);
    before.count += bins[k - 1].count;
    const double cost = before.box.half_surface() * static_cast<double>(before.count) +
                        from[k].box.half_surface() * static_cast<double>(from[k].count);
    if (before.count > 0 && from[k].count > 0 && cost < best.cost) best = {cost, axis, k};
  }
  return best;
}

// J. Goldsmith, J. Salmon, "Automatic creation of object hierarchies for ray tracing", IEEE CG&A 7(5), 1987, in bins.
std::size_t split_by_surface(Items items) {
  TreeBox centroids;
  for (const TreeItem& item : items) centroids.add({item.centroid, item.centroid});
  Place best;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(centroids.upper[axis] > centroids.lower[axis])) continue;
    std::array<Bin, bin_count> bins;
    for (const TreeItem& item : items) {
      Bin& bin = bins[bin_of(item.centroid[axis], centroids.lower[axis], centroids.upper[axis])];
      bin.box.add(item.box);
      ++bin.count;
    }
    const Place place = best_place(bins, axis);
    if (place.cost < best.cost) best = place;
  }
  if (best.first_of_second == 0) return 0;
  const auto right = std::stable_partition(items.begin(), items.end(), [&](const TreeItem& item) {
    return bin_of(item.centroid[best.axis], centroids.lower[best.axis], centroids.upper[best.axis]) < best.first_of_second;
  });
  return static_cast<std::size_t>(right - items.begin());
}

}  // namespace

void TreeBox::add(const TreeBox& other) {
  lower = glm::min(lower, other.lower);
  upper = glm::max(upper, other.upper);
}

double TreeBox::half_surface() const {
  const glm::dvec3 size = upper - lower;
  return size.x < 0 ? 0 : size.x * size.y + size.y * size.z + size.z * size.x;
}

std::size_t split_items(TreeSplit split, std::span<TreeItem> items, unsigned leaf_size) {
  PLIANT_EXPECT(items.size() > leaf_size);
  switch (split) {
    case TreeSplit::centre:
      break;
    case TreeSplit::median:
      return split_at_median(items, leaf_size);
    case TreeSplit::surface_area:
      return split_by_surface(items);
  }
  return split_at_centre(items);
}

}  // namespace pliant
