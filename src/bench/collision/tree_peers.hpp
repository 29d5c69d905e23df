// Other libraries' trees over two meshes, where the build found them: Embree, FCL and Bullet.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/collision/two_meshes.hpp"

namespace pliant::bench {

class TreePeer {
 public:
  virtual ~TreePeer() = default;
  /// Reads where vertices stand, for a library that needs that in a form of its own.
  virtual void read_places() {}
  /// Fits both trees to where the vertices stand.
  virtual void refit() = 0;
  /// Adds all pairs that may touch to `found`, or just those that touch if TreeLibrary::tests_triangles.
  virtual void find(TrianglePairs& found) = 0;
};

struct TreeLibrary {
  std::string name;      // with its version, such as "Embree 3.13.5"
  bool tests_triangles;  // find() finds those that touch, by the library's own test
  /// The meshes must outlive what it returns.
  std::function<std::unique_ptr<TreePeer>(const TwoMeshes&)> build;
};

/// Each of these is empty if the build did not find the package.
[[nodiscard]] std::vector<TreeLibrary> embree_trees();
[[nodiscard]] std::vector<TreeLibrary> fcl_trees();
[[nodiscard]] std::vector<TreeLibrary> bullet_trees();

}  // namespace pliant::bench
