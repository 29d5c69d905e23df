#include "bench/collision/tree_peers.hpp"
#ifdef PLIANT_BULLET
#include <BulletCollision/BroadphaseCollision/btDbvt.h>
#include <LinearMath/btScalar.h>
#include <fmt/format.h>
#endif

namespace pliant::bench {

#ifdef PLIANT_BULLET

namespace {

// Trees as btDbvt builds them from the top, and refits as Bullet's soft bodies make them.
class Bullet final : public TreePeer {
 public:
  explicit Bullet(const TwoMeshes& meshes) : meshes_(meshes) {
    for (std::uint32_t t = 0; t < meshes.triangles.size(); ++t)
      trees_[t < meshes.first_count ? 0 : 1].insert(box_of(t), reinterpret_cast<void*>(std::uintptr_t{t}));
    for (btDbvt& tree : trees_) tree.optimizeTopDown();
  }

  void refit() override {
    for (btDbvt& tree : trees_) fit(*tree.m_root);
  }
  void find(TrianglePairs& found) override {
    Adding adding(found);
    trees_[0].collideTT(trees_[0].m_root, trees_[1].m_root, adding);
  }

 private:
  struct Adding final : btDbvt::ICollide {
    explicit Adding(TrianglePairs& into) : found(into) {}
    void Process(const btDbvtNode* a, const btDbvtNode* b) override { found.emplace_back(triangle_of(*a), triangle_of(*b)); }
    TrianglePairs& found;
  };

  static std::uint32_t triangle_of(const btDbvtNode& leaf) {
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(leaf.data));
  }
  btDbvtVolume box_of(std::uint32_t t) const {
    btVector3 corners[3];
    for (std::uint32_t k = 0; k < 3; ++k) {
      const glm::vec4 at = meshes_.corner(t, k);
      corners[k] = btVector3(at.x, at.y, at.z);
    }
    return btDbvtVolume::FromPoints(corners, 3);
  }
  void fit(btDbvtNode& node) const {
    if (node.isleaf()) {
      node.volume = box_of(triangle_of(node));
      return;
    }
    fit(*node.childs[0]);
    fit(*node.childs[1]);
    Merge(node.childs[0]->volume, node.childs[1]->volume, node.volume);
  }

  const TwoMeshes& meshes_;
  btDbvt trees_[2];
};

}  // namespace

std::vector<TreeLibrary> bullet_trees() {
  return {{.name = fmt::format("Bullet {}.{}", btGetVersion() / 100, btGetVersion() % 100),
           .tests_triangles = false,
           .build = [](const TwoMeshes& meshes) { return std::make_unique<Bullet>(meshes); }}};
}

#else

std::vector<TreeLibrary> bullet_trees() { return {}; }

#endif

}  // namespace pliant::bench
