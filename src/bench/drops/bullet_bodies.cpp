#include "bench/drops/soft_peer.hpp"
#ifdef PLIANT_BULLET_BODIES
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>
#include <fmt/format.h>
#endif

namespace pliant::bench {

#ifdef PLIANT_BULLET_BODIES

namespace {

// What docs/benchmarks says of Bullet's bodies. Links hold edges and bending. Matching of the shape at rest stands for the
// springs across a body, which Bullet's have not. Bodies meet by vertices against faces.
constexpr float link_stiffness = 1, shape_matching = 0.1f, friction = 0.5f;
constexpr float margin = 0.01f;  // of a surface [m]. The default of 0.25 would let these bodies begin in each other
constexpr int solver_rounds = 10, bending_distance = 2, most_clusters = 16;

// How bodies meet: vertices meet faces and the floor, or convex clusters of vertices meet each other and the floor.
enum class Meeting { faces, clusters };

class Bullet final : public SoftPeer {
 public:
  Bullet(const Model& model, const State& start, double gravity, Meeting meeting)
      : meeting_(meeting), dispatcher_(&configuration_) {
    world_.setGravity(btVector3(0, -static_cast<float>(gravity), 0));
    surroundings_.m_broadphase = &broadphase_;
    surroundings_.m_dispatcher = &dispatcher_;
    surroundings_.m_gravity = world_.getGravity();
    surroundings_.m_sparsesdf.Initialize();
    floor_.setFriction(1);
    world_.addRigidBody(&floor_);
    const std::vector<glm::dvec3> positions = start.world_positions(model);
    for (const ModelBody& body : model.bodies) bodies_.push_back(soft_body(model, body, positions));
  }
  ~Bullet() override {
    for (const std::unique_ptr<btSoftBody>& body : bodies_) world_.removeSoftBody(body.get());
    world_.removeRigidBody(&floor_);
  }
  Bullet(const Bullet&) = delete;
  Bullet& operator=(const Bullet&) = delete;

  void step(double time_step) override { world_.stepSimulation(static_cast<float>(time_step), 0); }

  void read(std::span<glm::dvec3> positions, std::span<glm::dvec3> velocities) const override {
    std::size_t i = 0;
    for (const std::unique_ptr<btSoftBody>& body : bodies_)
      for (int n = 0; n < body->m_nodes.size(); ++n, ++i) {
        const btSoftBody::Node& node = body->m_nodes[n];
        positions[i] = {node.m_x.x(), node.m_x.y(), node.m_x.z()};
        velocities[i] = {node.m_v.x(), node.m_v.y(), node.m_v.z()};
      }
  }

 private:
  std::unique_ptr<btSoftBody> soft_body(const Model& model, const ModelBody& body, const std::vector<glm::dvec3>& positions) {
    std::vector<float> places;
    for (std::uint32_t i = body.first_vertex; i < body.first_vertex + body.vertex_count; ++i)
      for (int k = 0; k < 3; ++k) places.push_back(static_cast<float>(positions[i][k]));
    std::vector<int> corners;
    for (std::uint32_t t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t)
      for (const std::uint32_t corner : model.triangles[t]) corners.push_back(static_cast<int>(corner - body.first_vertex));
    std::unique_ptr<btSoftBody> soft(btSoftBodyHelpers::CreateFromTriMesh(surroundings_, places.data(), corners.data(),
                                                                          static_cast<int>(corners.size() / 3), false));
    btSoftBody::Material* const bending = soft->appendMaterial();
    soft->m_materials[0]->m_kLST = bending->m_kLST = link_stiffness;
    soft->generateBendingConstraints(bending_distance, bending);
    soft->m_cfg.piterations = solver_rounds;
    soft->m_cfg.kMT = shape_matching;
    soft->m_cfg.kDF = friction;
    using Collision = btSoftBody::fCollision;
    soft->m_cfg.collisions =
        meeting_ == Meeting::faces ? Collision::SDF_RS | Collision::VF_SS : Collision::CL_RS | Collision::CL_SS;
    soft->setTotalMass(static_cast<float>(body.vertex_mass * body.vertex_count));
    soft->setPose(false, true);
    soft->getCollisionShape()->setMargin(margin);
    if (meeting_ == Meeting::clusters) soft->generateClusters(most_clusters);
    world_.addSoftBody(soft.get());
    return soft;
  }

  Meeting meeting_;
  btSoftBodyRigidBodyCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btSoftRigidDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  btSoftBodyWorldInfo surroundings_;
  btStaticPlaneShape plane_{btVector3(0, 1, 0), 0};
  btRigidBody floor_{btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &plane_)};
  std::vector<std::unique_ptr<btSoftBody>> bodies_;
};

}  // namespace

std::vector<SoftLibrary> bullet_bodies() {
  const std::string name = fmt::format("Bullet {}.{}", btGetVersion() / 100, btGetVersion() % 100);
  const auto by = [](Meeting meeting) {
    return [meeting](const Model& model, const State& start, double gravity) -> std::unique_ptr<SoftPeer> {
      return std::make_unique<Bullet>(model, start, gravity, meeting);
    };
  };
  return {{name + ", faces", by(Meeting::faces)}, {name + ", clusters", by(Meeting::clusters)}};
}

#else

std::vector<SoftLibrary> bullet_bodies() { return {}; }

#endif

}  // namespace pliant::bench
