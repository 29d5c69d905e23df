#include "bench/collision/collision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <utility>

#include "bench/collision/engines.hpp"
#include "bench/collision/spheres.hpp"
#include "bench/common/timing.hpp"

namespace pliant::bench {
namespace {

constexpr int finest_level = 7, finest_quick_level = 4;
constexpr std::size_t many_spheres = 16;                                      // of the finest, first of all: 5 million triangles
constexpr double longest_brute_force = 3e7, longest_quick_brute_force = 2e6;  // pairs of triangles

// Each engine makes rounds until both have passed, and in a turn until `turn_seconds` have.
struct Rounds {
  std::size_t least;
  double least_seconds, turn_seconds;
};
constexpr Rounds all_rounds{15, 0.3, 0.005}, quick_rounds{3, 0.01, 0.005};

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

// One size and overlap. Its engines take turns, because a processor's clock changes while they are measured.
class Case {
 public:
  Case(std::size_t bodies, const Overlap& overlap, int level, bool quick)
      : overlap_(overlap),
        start_(spheres(bodies, level, overlap.apart)),
        meshes_(meshes_of(start_)),
        rounds_(quick ? quick_rounds : all_rounds) {}

  [[nodiscard]] std::uint32_t triangles() const { return meshes_.first_count; }

  void add(const Place& place, std::span<const Search> ways) {
    Device& device = *devices_.emplace_back(open(place));  // one for all, because a thread can have one context of OpenGL
    for (const Search& way : ways) add(way.name, place, make_engine(device, start_, way));
  }
  void add(const TreeLibrary& library) { add(library.name, {}, make_engine(library, meshes_)); }

  /// Lets each engine that has not measured enough take a turn. Returns false if there was none.
  bool take_turns() {
    bool all_have_enough = true;
    for (Entry& entry : entries_)
      if (!has_enough(entry)) {
        all_have_enough = false;
        take_turn(entry);
      }
    return !all_have_enough;
  }

  /// The first says what others have to find.
  [[nodiscard]] std::vector<CollisionRow> rows() const {
    std::vector<CollisionRow> rows;
    for (const Entry& entry : entries_)
      rows.push_back({.engine = entry.name,
                      .device = entry.place.device,
                      .threads = entry.place.threads,
                      .overlap = overlap_.name,
                      .bodies = start_.model.bodies.size(),
                      .triangles = triangles(),
                      .build_seconds = entry.engine->build_seconds(),
                      .refit_seconds = median(entry.refits),
                      .query_seconds = median(entry.queries),
                      .pairs = entry.found.pairs,
                      .agrees = entry.found == entries_.front().found});
    return rows;
  }

 private:
  struct Entry {
    std::string name;
    Place place;
    std::unique_ptr<Engine> engine;
    Found found;
    std::vector<double> refits = {}, queries = {};
    double seconds = 0;
  };

  void add(std::string name, const Place& place, std::unique_ptr<Engine> engine) {
    Found found = engine->find();
    entries_.push_back({std::move(name), place, std::move(engine), std::move(found)});
  }

  [[nodiscard]] bool has_enough(const Entry& entry) const {
    return entry.refits.size() >= rounds_.least && entry.seconds >= rounds_.least_seconds;
  }

  void take_turn(Entry& entry) const {
    (void)entry.engine->make_rounds();  // fills caches, wakes threads
    for (double passed = 0; passed < rounds_.turn_seconds;)
      for (const RoundSeconds& round : entry.engine->make_rounds()) {
        entry.refits.push_back(round.refit);
        entry.queries.push_back(round.query);
        passed += round.refit + round.query;
        entry.seconds += round.refit + round.query;
      }
  }

  const Overlap& overlap_;
  ModelAndState start_;
  TwoMeshes meshes_;
  Rounds rounds_;
  std::vector<std::unique_ptr<Device>> devices_;
  std::vector<Entry> entries_;
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

std::span<const Search> ways_to_search(const Case& what, bool quick) {
  const bool by_brute_force =
      double(what.triangles()) * what.triangles() <= (quick ? longest_quick_brute_force : longest_brute_force);
  return searches().first(searches().size() - !by_brute_force);
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
  const auto measure = [&](Case& what, const std::string& name) {
    do
      if (!tell(name)) return;
    while (what.take_turns());
    std::ranges::move(what.rows(), std::back_inserter(result.rows));
    ++done;
  };
  if (!of_many.empty()) {
    Case what(many_spheres, overlaps[1], finest, options.quick);
    for (const Place& place : of_many) what.add(place, searches().first(1));
    measure(what, fmt::format("{} bodies of {} triangles", many_spheres, what.triangles()));
    if (result.interrupted) return result;
  }
  for (int level = 3; level <= finest; ++level) {
    for (const Overlap& overlap : overlaps) {
      Case what(2, overlap, level, options.quick);
      const std::string name = fmt::format("{} triangles each, {}", what.triangles(), overlap.name);
      for (const Place& place : places)
        if (tell(fmt::format("{}, {}", name, name_of(place)))) what.add(place, ways_to_search(what, options.quick));
      for (const TreeLibrary& library : libraries)
        if (tell(fmt::format("{}, {}", name, library.name))) what.add(library);
      measure(what, name);
      if (result.interrupted) return result;
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
