#include "bench/collision/tree_peers.hpp"
#ifdef PLIANT_FCL
#include <fcl/fcl.h>
#include <fmt/format.h>

#include <limits>
#endif

namespace pliant::bench {

#ifdef PLIANT_FCL

namespace {

class Fcl final : public TreePeer {
 public:
  explicit Fcl(const TwoMeshes& meshes) : meshes_(meshes) {
    make(*first_, meshes.first());
    make(*second_, meshes.second());
  }

  void refit() override {
    update(*first_, meshes_.first());
    update(*second_, meshes_.second());
  }
  void find(TrianglePairs& found) override {
    const fcl::CollisionRequest<double> request(std::numeric_limits<int>::max(), true);
    fcl::CollisionResult<double> result;
    const fcl::Transform3<double> stays = fcl::Transform3<double>::Identity();
    fcl::collide(first_.get(), stays, second_.get(), stays, request, result);
    for (std::size_t k = 0; k < result.numContacts(); ++k) {
      const fcl::Contact<double>& contact = result.getContact(k);
      found.emplace_back(contact.b1, meshes_.first_count + static_cast<std::uint32_t>(contact.b2));
    }
  }

 private:
  using Tree = fcl::BVHModel<fcl::AABB<double>>;

  fcl::Vector3<double> corner(const Triangle& triangle, std::uint32_t k) const {
    const glm::vec4& at = meshes_.positions[triangle[k]];
    return {at.x, at.y, at.z};
  }
  // Triangles have corners of their own, in the order in which they are updated.
  void make(Tree& tree, std::span<const Triangle> triangles) const {
    tree.beginModel(static_cast<int>(triangles.size()), static_cast<int>(3 * triangles.size()));
    for (const Triangle& t : triangles) tree.addTriangle(corner(t, 0), corner(t, 1), corner(t, 2));
    tree.endModel();
  }
  void update(Tree& tree, std::span<const Triangle> triangles) const {
    tree.beginUpdateModel();
    for (const Triangle& t : triangles) tree.updateTriangle(corner(t, 0), corner(t, 1), corner(t, 2));
    tree.endUpdateModel(true, true);
  }

  const TwoMeshes& meshes_;
  std::shared_ptr<Tree> first_ = std::make_shared<Tree>(), second_ = std::make_shared<Tree>();
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
