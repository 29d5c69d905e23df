// Every way to build and refit trees.
#pragma once
#include <vector>

#include "scene/scene_description.hpp"

namespace pliant::test {

/// Returns each split, fan-out and refit at least once, and the device's own choice first.
inline std::vector<TreeDescription> all_trees() {
  std::vector<TreeDescription> trees{{}};
  for (const TreeSplit split : {TreeSplit::centre, TreeSplit::median, TreeSplit::surface_area}) {
    trees.push_back({.split = split, .fan_out = 2, .refit = TreeRefit::bottom_up});
    trees.push_back({.split = split, .fan_out = 4, .refit = TreeRefit::hybrid});
    trees.push_back({.split = split, .fan_out = 8, .refit = TreeRefit::bottom_up});
  }
  trees.push_back({.fan_out = 8, .refit = TreeRefit::hybrid});
  return trees;
}

}  // namespace pliant::test
