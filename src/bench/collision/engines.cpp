#include "bench/collision/engines.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "core/stopwatch.hpp"
#include "physics/collision/box.glsl"
#include "physics/collision/certified_triangles.glsl"

namespace pliant::bench {
namespace {

constexpr int rounds_together = 8;  // on a GPU, which slows down where it waits after each

physics::PaddedBox box_of(const TwoMeshes& meshes, std::uint32_t triangle) {
  const glm::vec4 p = meshes.corner(triangle, 0), q = meshes.corner(triangle, 1), r = meshes.corner(triangle, 2);
  return {glm::min(glm::min(p, q), r), glm::max(glm::max(p, q), r)};
}

// Embree gives all pairs of triangles of two leaves, so boxes are tested first.
bool touch(const TwoMeshes& meshes, glm::uvec2 pair) {
  if (!physics::overlaps(box_of(meshes, pair.x), box_of(meshes, pair.y))) return false;
  const auto corner = [&](std::uint32_t triangle, std::uint32_t k) { return glm::vec3(meshes.corner(triangle, k)); };
  const glm::vec3 p[3] = {corner(pair.x, 0), corner(pair.x, 1), corner(pair.x, 2)};
  const glm::vec3 q[3] = {corner(pair.y, 0), corner(pair.y, 1), corner(pair.y, 2)};
  return physics::triangles_may_touch(p, q);
}

CollisionDescription description_of(const Search& search) {
  CollisionDescription description;
  description.search = search.method;
  description.tree = search.tree;
  description.response = {"none"};
  return description;
}

class Pliant final : public Engine {
 public:
  Pliant(Device& device, const ModelAndState& start, const TwoMeshes& meshes, const Search& search)
      : device_(device),
        meshes_(meshes),
        bodies_(device, start.model, start.state),
        collider_(bodies_, start.model, description_of(search), {}) {
    if (search.method == ContactSearch::tree)
      building_.time([&] { (void)build_forest(start.model, start.model.rest_positions, search.tree); });
    pairing_ = collider_.pairing_passes(0);
    refitting_ = collider_.refitting_passes(0);
    querying_ = collider_.finding_passes();
    std::ranges::move(collider_.testing_passes(0), std::back_inserter(querying_));
  }

  double build_seconds() const override { return building_.seconds(); }

  // Threads of a processor have fallen asleep meanwhile. Within a step they are awake, so they bound bodies until they are.
  void read_places() override {
    constexpr double waking_seconds = 1e-4;
    bodies_.world_positions.upload(meshes_.positions);
    bodies_.prepare_search();
    Stopwatch waking;
    do waking.time([&] { device_.run(std::array{collider_.bounding_pass(0)}); });
    while (device_.info().kind == DeviceKind::cpu && waking.seconds() < waking_seconds);
  }

  Found find() override {
    search();
    (void)device_.take_times();
    const physics::Control control = bodies_.control.download().front();
    Found found{control.count[physics::contact_pairs], {}};
    for (const std::uint32_t step : collider_.touching().marks()) found.touched.push_back(step == control.step);
    end();
    return found;
  }

  std::vector<RoundSeconds> make_rounds() override {
    const int rounds = device_.info().kind == DeviceKind::gpu ? rounds_together : 1;
    for (int round = 0; round < rounds; ++round) {
      search();
      end();
    }
    const std::vector<double> at = device_.take_times();
    std::vector<RoundSeconds> taken;
    for (std::size_t k = 0; k < at.size(); k += 3) taken.push_back({at[k + 1] - at[k], at[k + 2] - at[k + 1]});
    return taken;
  }

 private:
  void search() {
    device_.run(pairing_);
    device_.mark_time();
    device_.run(refitting_);
    device_.mark_time();
    device_.run(querying_);
    device_.mark_time();
  }
  void end() { device_.run(std::array{end_}); }

  Device& device_;
  const TwoMeshes& meshes_;
  DeviceBodies bodies_;
  Collider collider_;
  Stopwatch building_;
  std::vector<Pass> pairing_, refitting_, querying_;
  Pass end_ = make_pass(bodies_.arrays, "finish_step", {}, physics::counter_count);
};

class Library final : public Engine {
 public:
  Library(const TreeLibrary& library, const TwoMeshes& meshes) : library_(library), meshes_(meshes) {
    building_.time([&] { peer_ = library.build(meshes); });
  }

  double build_seconds() const override { return building_.seconds(); }
  void read_places() override { peer_->read_places(); }

  Found find() override {
    make_rounds();
    Found found{pairs_.size(), std::vector<bool>(meshes_.positions.size())};
    for (const glm::uvec2& pair : pairs_)
      for (const std::uint32_t triangle : {pair.x, pair.y})
        for (const std::uint32_t vertex : meshes_.triangles[triangle]) found.touched[vertex] = true;
    return found;
  }

  std::vector<RoundSeconds> make_rounds() override {
    Stopwatch refit, query;
    refit.time([&] { peer_->refit(); });
    query.time([&] {
      pairs_.clear();
      peer_->find(pairs_);
      if (!library_.tests_triangles) std::erase_if(pairs_, [&](glm::uvec2 pair) { return !touch(meshes_, pair); });
    });
    return {{refit.seconds(), query.seconds()}};
  }

 private:
  const TreeLibrary& library_;
  const TwoMeshes& meshes_;
  Stopwatch building_;
  std::unique_ptr<TreePeer> peer_;
  TrianglePairs pairs_;
};

}  // namespace

std::span<const Search> searches() {
  static constexpr std::array all = {Search{"pliant"},
                                     Search{"pliant, bottom-up", ContactSearch::tree, {.refit = TreeRefit::bottom_up}},
                                     Search{"pliant, fan-out 2", ContactSearch::tree, {.fan_out = 2}},
                                     Search{"pliant, fan-out 4", ContactSearch::tree, {.fan_out = 4}},
                                     Search{"pliant, centre", ContactSearch::tree, {.split = TreeSplit::centre}},
                                     Search{"pliant, surface area", ContactSearch::tree, {.split = TreeSplit::surface_area}},
                                     Search{"brute force", ContactSearch::brute_force}};
  return all;
}

std::unique_ptr<Engine> make_engine(Device& device, const ModelAndState& start, const TwoMeshes& meshes, const Search& search) {
  return std::make_unique<Pliant>(device, start, meshes, search);
}

std::unique_ptr<Engine> make_engine(const TreeLibrary& library, const TwoMeshes& meshes) {
  return std::make_unique<Library>(library, meshes);
}

}  // namespace pliant::bench
