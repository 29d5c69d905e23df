#include "bench/collision/collision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>

#include "bench/collision/spheres.hpp"
#include "bench/collision/tree_peers.hpp"
#include "bench/common/timing.hpp"
#include "collision/collider.hpp"
#include "core/stopwatch.hpp"
#include "physics/collision/box.glsl"
#include "physics/collision/certified_triangles.glsl"

namespace pliant::bench {
namespace {

constexpr int finest_level = 7, finest_quick_level = 4;
constexpr std::size_t many_spheres = 16;                                      // of the finest, first of all: 5 million triangles
constexpr double longest_brute_force = 3e7, longest_quick_brute_force = 2e6;  // pairs of triangles

// Rounds are repeated until both have passed.
struct Rounds {
  std::size_t least;
  double least_seconds;
};
constexpr Rounds all_rounds{15, 0.3}, quick_rounds{3, 0.01};
constexpr int rounds_of_a_batch = 8;  // a GPU slows down where it waits after each

struct Seconds {
  double refit, query;
};

// Returns medians. `batch` makes some rounds. Those of the first third of the time warm up.
template <class Batch>
Seconds repeated(const Rounds& rounds, const Batch& batch) {
  std::vector<double> refits, queries;
  for (double passed = 0; passed < rounds.least_seconds / 3;)
    for (const Seconds& taken : batch()) passed += taken.refit + taken.query;
  for (double passed = 0; refits.size() < rounds.least || passed < rounds.least_seconds;)
    for (const Seconds& taken : batch()) {
      refits.push_back(taken.refit);
      queries.push_back(taken.query);
      passed += taken.refit + taken.query;
    }
  return {median(refits), median(queries)};
}

struct Overlap {
  const char* name;
  glm::dvec3 apart;  // of the spheres' centres, in radii
};

// Spheres that are apart have boxes that overlap. Others overlap by this part of their diameter.
const std::array<Overlap, 3> overlaps = {Overlap{"apart", {1.2, 1.2, 1.2}}, Overlap{"5 %", {1.9, 0, 0}},
                                         Overlap{"50 %", {1, 0, 0}}};

TwoMeshes meshes_of(const ModelAndState& start) {
  TwoMeshes meshes;
  for (const glm::dvec3& place : start.state.world_positions(start.model)) meshes.positions.emplace_back(glm::vec3(place), 1.0f);
  meshes.triangles = start.model.triangles;
  meshes.first_count = start.model.bodies[0].triangle_count;
  return meshes;
}

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

struct Found {
  std::uint64_t pairs = 0;
  std::vector<bool> touched;  // vertices

  bool operator==(const Found&) const = default;
};

// How pliant searches: a row of the result. The first has what is best on the device.
struct Search {
  const char* name;
  ContactSearch method = ContactSearch::tree;
  TreeDescription tree{};
};
const std::array<Search, 7> searches = {Search{"pliant"},
                                        Search{"pliant, bottom-up", ContactSearch::tree, {.refit = TreeRefit::bottom_up}},
                                        Search{"pliant, fan-out 2", ContactSearch::tree, {.fan_out = 2}},
                                        Search{"pliant, fan-out 4", ContactSearch::tree, {.fan_out = 4}},
                                        Search{"pliant, centre", ContactSearch::tree, {.split = TreeSplit::centre}},
                                        Search{"pliant, surface area", ContactSearch::tree, {.split = TreeSplit::surface_area}},
                                        Search{"brute force", ContactSearch::brute_force}};

// One size and overlap. The first row says what others have to find.
class Case {
 public:
  Case(std::size_t bodies, const Overlap& overlap, int level, bool quick, CollisionResult& into)
      : overlap_(overlap),
        start_(spheres(bodies, level, overlap.apart)),
        meshes_(meshes_of(start_)),
        rounds_(quick ? quick_rounds : all_rounds),
        into_(into) {}

  [[nodiscard]] std::uint32_t triangles() const { return meshes_.first_count; }

  void measure(const Place& place, const Search& search) {
    const auto device = open(place);
    CollisionDescription description;
    description.search = search.method;
    description.tree = search.tree;
    description.response = {"none"};
    const bool has_trees = search.method == ContactSearch::tree;
    DeviceBodies bodies(*device, start_.model, start_.state);
    Collider collider(bodies, start_.model, description, {});
    device->run(std::array{collider.bounding_pass(0)});
    const Pass end = make_pass(bodies.arrays, "finish_step", {}, physics::counter_count);
    const std::vector<Pass> pairing = collider.pairing_passes(0), refitting = collider.refitting_passes(0);
    std::vector<Pass> querying = collider.finding_passes();
    std::ranges::move(collider.testing_passes(0), std::back_inserter(querying));
    const auto make_round = [&] {
      device->run(pairing);
      device->mark_time();
      device->run(refitting);
      device->mark_time();
      device->run(querying);
      device->mark_time();
    };
    make_round();
    (void)device->take_times();
    const Found found = what_it_found(bodies, collider);
    device->run(std::array{end});
    const Seconds seconds = repeated(rounds_, [&] {
      for (int round = 0; round < rounds_of_a_batch; ++round) {
        make_round();
        device->run(std::array{end});
      }
      const std::vector<double> at = device->take_times();
      std::vector<Seconds> taken;
      for (std::size_t k = 0; k < at.size(); k += 3) taken.push_back({at[k + 1] - at[k], at[k + 2] - at[k + 1]});
      return taken;
    });
    add(search.name, place.device, place.threads, has_trees ? seconds_of_build(search.tree) : 0, seconds, found);
  }

  void measure(const TreeLibrary& library) {
    Stopwatch building;
    building.start();
    const std::unique_ptr<TreePeer> peer = library.build(meshes_);
    building.stop();
    TrianglePairs pairs;
    const Seconds seconds = repeated(rounds_, [&] {
      Stopwatch refit, query;
      refit.time([&] { peer->refit(); });
      query.time([&] {
        pairs.clear();
        peer->find(pairs);
        if (!library.tests_triangles) std::erase_if(pairs, [&](glm::uvec2 pair) { return !touch(meshes_, pair); });
      });
      return std::array{Seconds{refit.seconds(), query.seconds()}};
    });
    add(library.name, DeviceKind::cpu, 1, building.seconds(), seconds, what_it_found(pairs));
  }

 private:
  [[nodiscard]] double seconds_of_build(const TreeDescription& tree) const {
    Stopwatch building;
    building.time([&] { (void)build_forest(start_.model, start_.model.rest_positions, tree); });
    return building.seconds();
  }

  static Found what_it_found(const DeviceBodies& bodies, const Collider& collider) {
    const physics::Control control = bodies.control.download().front();
    Found found{control.count[physics::contact_pairs], {}};
    for (const std::uint32_t step : collider.touching().marks()) found.touched.push_back(step == control.step);
    return found;
  }
  [[nodiscard]] Found what_it_found(const TrianglePairs& pairs) const {
    Found found{pairs.size(), std::vector<bool>(meshes_.positions.size())};
    for (const glm::uvec2& pair : pairs)
      for (const std::uint32_t triangle : {pair.x, pair.y})
        for (const std::uint32_t vertex : meshes_.triangles[triangle]) found.touched[vertex] = true;
    return found;
  }

  void add(const std::string& engine, DeviceKind device, unsigned threads, double build, const Seconds& seconds,
           const Found& found) {
    if (!first_) first_ = found;
    into_.rows.push_back({.engine = engine,
                          .device = device,
                          .threads = threads,
                          .overlap = overlap_.name,
                          .bodies = start_.model.bodies.size(),
                          .triangles = triangles(),
                          .build_seconds = build,
                          .refit_seconds = seconds.refit,
                          .query_seconds = seconds.query,
                          .pairs = found.pairs,
                          .agrees = found == *first_});
  }

  const Overlap& overlap_;
  ModelAndState start_;
  TwoMeshes meshes_;
  Rounds rounds_;
  CollisionResult& into_;
  std::optional<Found> first_;
};

std::vector<TreeLibrary> tree_libraries(std::vector<std::string>& notes) {
  std::vector<TreeLibrary> all;
  for (const auto& [name, libraries] : {std::pair("Embree", embree_trees()), {"FCL", fcl_trees()}, {"Bullet", bullet_trees()}}) {
    all.insert(all.end(), libraries.begin(), libraries.end());
    if (libraries.empty())
      notes.push_back(fmt::format("{}: left out, as the build did not find it; `tools/build comparisons` adds it", name));
  }
  return all;
}

// Opens the device, because it alone knows.
bool is_gpu_in_hardware(const Place& place) { return place.device == DeviceKind::gpu && open(place)->shares_at_once() > 0; }

bool is_short_enough(const Case& what, bool quick) {
  return double(what.triangles()) * what.triangles() <= (quick ? longest_quick_brute_force : longest_brute_force);
}

}  // namespace

CollisionResult bench_collision(const CollisionOptions& options, const Progress& progress) {
  constexpr int precisions[] = {32};
  CollisionResult result;
  const std::vector<Place> places = places_of(options.devices, precisions);
  const std::vector<TreeLibrary> libraries = tree_libraries(result.notes);
  const int finest = options.quick ? finest_quick_level : finest_level;
  std::vector<Place> of_many;
  std::ranges::copy_if(places, std::back_inserter(of_many),
                       [&](const Place& place) { return options.quick || is_gpu_in_hardware(place); });
  const int cases = (finest - 2) * (static_cast<int>(overlaps.size()) + 1) + !of_many.empty();
  int done = 0;
  const auto tell = [&](const std::string& what) {
    if (!result.interrupted) result.interrupted = !progress(double(done) / cases, what);
    return !result.interrupted;
  };
  if (!of_many.empty()) {
    Case what(many_spheres, overlaps[1], finest, options.quick, result);
    for (const Place& place : of_many)
      if (tell(fmt::format("{} bodies of {} triangles, {}", many_spheres, what.triangles(), name_of(place))))
        what.measure(place, searches[0]);
    if (result.interrupted) return result;
    ++done;
  }
  for (int level = 3; level <= finest; ++level) {
    for (const Overlap& overlap : overlaps) {
      Case what(2, overlap, level, options.quick, result);
      const std::string size = fmt::format("{} triangles each, {}", what.triangles(), overlap.name);
      for (const Place& place : places)
        for (const Search& search : searches)
          if (search.method == ContactSearch::tree || is_short_enough(what, options.quick))
            if (tell(fmt::format("{}, {}, {}", size, search.name, name_of(place)))) what.measure(place, search);
      for (const TreeLibrary& library : libraries)
        if (tell(fmt::format("{}, {}", size, library.name))) what.measure(library);
      if (result.interrupted) return result;
      ++done;
    }
    for (const Place& place : places)
      if (tell(fmt::format("a step in contact, icosphere:{}, {}", level, name_of(place))))
        result.contact_steps.push_back(measure_contact_step(place, level, options.quick));
    if (result.interrupted) return result;
    ++done;
  }
  progress(1, "");
  return result;
}

}  // namespace pliant::bench
