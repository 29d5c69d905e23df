#include "bench/collision/tree_peers.hpp"
#ifdef PLIANT_FCL
#include <fcl/fcl.h>
#include <fcl/narrowphase/detail/traversal/collision/mesh_collision_traversal_node.h>
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#endif

namespace pliant::bench {

#ifdef PLIANT_FCL

namespace {

class Fcl final : public TreePeer {
 public:
  explicit Fcl(const TwoMeshes& meshes) : meshes_(meshes), vertices_(meshes.positions.size()) {
    read_places();
    make(*first_, meshes.first());
    make(*second_, meshes.second());
  }

  void read_places() override {
    std::ranges::transform(meshes_.positions, vertices_.begin(),
                           [](const glm::vec4& at) { return fcl::Vector3<double>(at.x, at.y, at.z); });
  }
  void refit() override {
    for (Tree* tree : {first_.get(), second_.get()}) {
      tree->beginReplaceModel();
      tree->replaceSubModel(vertices_);
      tree->endReplaceModel(true, true);
    }
  }
  // fcl::collide would copy both trees with each call. Contacts are not asked for, as each pair might have two.
  void find(TrianglePairs& found) override {
    const fcl::CollisionRequest<double> request(std::numeric_limits<int>::max(), false);
    fcl::CollisionResult<double> result;
    fcl::Transform3<double> of_first = fcl::Transform3<double>::Identity(), of_second = of_first;
    fcl::detail::MeshCollisionTraversalNode<Box> traversal;
    fcl::detail::initialize(traversal, *first_, of_first, *second_, of_second, request, result);
    fcl::detail::collide(&traversal);
    for (std::size_t k = 0; k < result.numContacts(); ++k) {
      const fcl::Contact<double>& contact = result.getContact(k);
      found.emplace_back(contact.b1, meshes_.first_count + static_cast<std::uint32_t>(contact.b2));
    }
  }

 private:
  using Box = fcl::AABB<double>;
  using Tree = fcl::BVHModel<Box>;

  // Either tree has the vertices of both meshes, and triangles of its own.
  void make(Tree& tree, std::span<const Triangle> triangles) const {
    std::vector<fcl::Triangle> corners;
    for (const Triangle& t : triangles) corners.emplace_back(t[0], t[1], t[2]);
    tree.beginModel(static_cast<int>(corners.size()), static_cast<int>(vertices_.size()));
    tree.addSubModel(vertices_, corners);
    tree.endModel();
  }

  const TwoMeshes& meshes_;
  std::vector<fcl::Vector3<double>> vertices_;
  std::unique_ptr<Tree> first_ = std::make_unique<Tree>(), second_ = std::make_unique<Tree>();
};

}  // namespace

std::vector<TreeLibrary> fcl_trees() {
  return {{.name = fmt::format("FCL {}", FCL_VERSION), .tests_triangles = true, .build = [](const TwoMeshes& meshes) {
             return std::make_unique<Fcl>(meshes);
           }}};
}

#else

std::vector<TreeLibrary> fcl_trees() { return {}; }

#endif

}  // namespace pliant::bench
