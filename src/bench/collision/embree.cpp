#include "bench/collision/tree_peers.hpp"
#ifdef PLIANT_EMBREE
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#endif

namespace pliant::bench {

#ifdef PLIANT_EMBREE

namespace {

// Scenes of triangles as user geometries, because rtcCollide takes no others.
class Embree final : public TreePeer {
 public:
  explicit Embree(const TwoMeshes& meshes) : meshes_(meshes), device_(rtcNewDevice("threads=1")) {
    if (device_ == nullptr) fail();
    const auto second = static_cast<std::uint32_t>(meshes.triangles.size()) - meshes.first_count;
    sides_[0] = {&meshes_, 0};
    sides_[1] = {&meshes_, meshes.first_count};
    make(0, meshes.first_count);
    make(1, second);
  }
  ~Embree() override {
    for (const RTCScene scene : scenes_) rtcReleaseScene(scene);
    rtcReleaseDevice(device_);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  void refit() override {
    for (int k = 0; k < 2; ++k) {
      rtcCommitGeometry(geometries_[k]);
      rtcCommitScene(scenes_[k]);
    }
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) fail();
  }
  void find(TrianglePairs& found) override {
    Found into{&found, meshes_.first_count};
    rtcCollide(scenes_[0], scenes_[1], add, &into);
  }

 private:
  struct Side {
    const TwoMeshes* meshes = nullptr;
    std::uint32_t first_triangle = 0;
  };
  struct Found {
    TrianglePairs* pairs;
    std::uint32_t first_of_second;
  };

  [[noreturn]] static void fail() {
    throw Error(ErrorKind::device, "Embree", "cannot make or refit its trees", "measure in a build without libembree-dev");
  }

  static void bound(const RTCBoundsFunctionArguments* asked) {
    const auto& side = *static_cast<const Side*>(asked->geometryUserPtr);
    const std::uint32_t t = side.first_triangle + asked->primID;
    const glm::vec4 p = side.meshes->corner(t, 0), q = side.meshes->corner(t, 1), r = side.meshes->corner(t, 2);
    RTCBounds& box = *asked->bounds_o;
    box.lower_x = std::min({p.x, q.x, r.x});
    box.lower_y = std::min({p.y, q.y, r.y});
    box.lower_z = std::min({p.z, q.z, r.z});
    box.upper_x = std::max({p.x, q.x, r.x});
    box.upper_y = std::max({p.y, q.y, r.y});
    box.upper_z = std::max({p.z, q.z, r.z});
  }
  static void add(void* into, RTCCollision* collisions, unsigned count) {
    const auto& found = *static_cast<Found*>(into);
    for (unsigned k = 0; k < count; ++k)
      found.pairs->emplace_back(collisions[k].primID0, found.first_of_second + collisions[k].primID1);
  }

  void make(int k, std::uint32_t triangle_count) {
    scenes_[k] = rtcNewScene(device_);
    rtcSetSceneFlags(scenes_[k], RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(scenes_[k], RTC_BUILD_QUALITY_LOW);  // others build anew
    geometries_[k] = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometries_[k], triangle_count);
    rtcSetGeometryUserData(geometries_[k], &sides_[k]);
    rtcSetGeometryBoundsFunction(geometries_[k], bound, nullptr);
    rtcSetGeometryBuildQuality(geometries_[k], RTC_BUILD_QUALITY_MEDIUM);
    rtcCommitGeometry(geometries_[k]);
    rtcAttachGeometry(scenes_[k], geometries_[k]);
    rtcReleaseGeometry(geometries_[k]);
    rtcCommitScene(scenes_[k]);
    rtcSetGeometryBuildQuality(geometries_[k], RTC_BUILD_QUALITY_REFIT);
  }

  const TwoMeshes& meshes_;
  RTCDevice device_;
  Side sides_[2];
  RTCScene scenes_[2] = {};
  RTCGeometry geometries_[2] = {};
};

}  // namespace

std::vector<TreeLibrary> embree_trees() {
  return {{.name = fmt::format("Embree {}", RTC_VERSION_STRING), .tests_triangles = false, .build = [](const TwoMeshes& meshes) {
             return std::make_unique<Embree>(meshes);
           }}};
}

#else

std::vector<TreeLibrary> embree_trees() { return {}; }

#endif

}  // namespace pliant::bench
