#include "bench/collision/collision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/gtc/quaternion.hpp>
#include <iterator>
#include <memory>
#include <numeric>
#include <span>
#include <utility>

#include "bench/collision/engines.hpp"
#include "bench/collision/spheres.hpp"
#include "bench/common/timing.hpp"
#include "core/stopwatch.hpp"

namespace pliant::bench {
namespace {

constexpr int finest_level = 7, finest_quick_level = 4;
constexpr std::size_t many_spheres = 16;                                      // of the finest, first of all: 5 million triangles
constexpr double longest_brute_force = 3e7, longest_quick_brute_force = 2e6;  // pairs of triangles

// Each engine has so many turns, and makes rounds for so long in each. Before each of them a GPU works for a while, because it
// lowers its clocks when it waits: after 0.1 s an H200 was as fast as if it had not waited. Quick figures are of low clocks.
struct Turns {
  int count;
  double seconds;
  double seconds_before_gpu;
};
constexpr Turns all_turns{15, 0.02, 0.1}, quick_turns{3, 0.003, 0};
constexpr int most_rounds = 64;  // of a turn, as bodies are turned between them, which is not counted but takes time

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

// One size and overlap. Its engines take turns, because a processor's clock changes while they are measured. For a processor
// bodies turn about their centres before each round. If it makes the same search again, it learns which way branches go: two
// spheres of 5,120 triangles took one thread two thirds of the time that way. A GPU does not, and should not wait for turned
// bodies.
class Case {
 public:
  Case(std::size_t bodies, const Overlap& overlap, int level, bool quick)
      : overlap_(overlap),
        start_(spheres(bodies, level, overlap.apart)),
        meshes_(meshes_of(start_)),
        turns_(quick ? quick_turns : all_turns) {
    const std::vector<glm::dvec3> places = start_.state.world_positions(start_.model);
    for (const ModelBody& body : start_.model.bodies) {
      const auto of_body = std::span(places).subspan(body.first_vertex, body.vertex_count);
      centres_.push_back(std::reduce(of_body.begin(), of_body.end(), glm::dvec3(0)) / double(body.vertex_count));
      for (const glm::dvec3& place : of_body) arms_.push_back(place - centres_.back());
    }
  }

  [[nodiscard]] std::uint32_t triangles() const { return meshes_.first_count; }

  /// Returns a device of the case. A place has one for all its searches, because a thread can have one context of OpenGL.
  Device& open_device(const Place& place) { return *devices_.emplace_back(open(place)); }
  void add(Device& device, const Place& place, const Search& search) {
    add(search.name, place, make_engine(device, start_, meshes_, search));
  }
  void add(const TreeLibrary& library) { add(library.name, Place{.threads = 1}, make_engine(library, meshes_)); }

  [[nodiscard]] int turn_count() const { return turns_.count; }
  void take_turns() {
    ++turns_taken_;
    for (Entry& entry : entries_) take_turn(entry);
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
                      .pairs = entry.found.front().pairs,
                      .agrees = entry.found == entries_.front().found});
    return rows;
  }

 private:
  struct Entry {
    std::string name;
    Place place;
    std::unique_ptr<Engine> engine;
    std::vector<Found> found;  // at some places
    std::vector<double> refits = {}, queries = {};
  };

  // Compares what engines find at places for which their trees were not built.
  void add(std::string name, const Place& place, std::unique_ptr<Engine> engine) {
    std::vector<Found> found;
    for (const int turned : {1, 2}) {
      turn_bodies(turned);
      engine->read_places();
      found.push_back(engine->find());
    }
    turn_bodies(0);
    entries_.push_back({std::move(name), place, std::move(engine), std::move(found)});
  }

  // All engines begin a turn at the same places, which no other turn has. They come to as many more as they make rounds.
  void take_turn(Entry& entry) {
    const int first = most_rounds * turns_taken_;
    turn_bodies(first);
    entry.engine->read_places();
    warm_up(entry);
    double passed = 0;
    for (int round = 1; round < most_rounds && passed < turns_.seconds; ++round) {
      if (entry.place.device == DeviceKind::cpu) {
        turn_bodies(first + round);
        entry.engine->read_places();
      }
      for (const RoundSeconds& taken : entry.engine->make_rounds()) {
        entry.refits.push_back(taken.refit);
        entry.queries.push_back(taken.query);
        passed += taken.refit + taken.query;
      }
    }
  }

  // Fills caches, and lets a GPU raise its clocks.
  void warm_up(Entry& entry) const {
    const double least = entry.place.device == DeviceKind::gpu ? turns_.seconds_before_gpu : 0;
    Stopwatch working;
    do working.time([&] { entry.engine->make_rounds(); });
    while (working.seconds() < least);
  }

  void turn_bodies(int times) {
    constexpr double angle = 2.4;  // [rad]
    const glm::dquat turned = glm::angleAxis(angle * times, glm::normalize(glm::dvec3(1, 2, 3)));
    for (std::size_t b = 0; b < centres_.size(); ++b) {
      const ModelBody& body = start_.model.bodies[b];
      for (std::uint32_t i = body.first_vertex; i < body.first_vertex + body.vertex_count; ++i)
        meshes_.positions[i] = glm::vec4(centres_[b] + turned * arms_[i], 1);
    }
  }

  const Overlap& overlap_;
  ModelAndState start_;
  TwoMeshes meshes_;
  std::vector<glm::dvec3> centres_, arms_;  // of bodies, and from there to vertices
  Turns turns_;
  int turns_taken_ = 0;
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

std::span<const Search> searches_of(const Case& what, bool quick) {
  const bool by_brute_force =
      double(what.triangles()) * what.triangles() <= (quick ? longest_quick_brute_force : longest_brute_force);
  return searches().first(searches().size() - !by_brute_force);
}

class Suite {
 public:
  Suite(const CollisionOptions& options, const Progress& progress) : quick_(options.quick), progress_(progress) {
    constexpr int precisions[] = {32};
    places_ = places_of(options.devices, precisions);
    libraries_ = tree_libraries(result_.notes);
    std::ranges::copy_if(places_, std::back_inserter(places_of_many_),
                         [&](const Place& place) { return quick_ || is_gpu_in_hardware(place); });
  }

  CollisionResult run() {
    if (!places_of_many_.empty()) measure_many();
    for (int level = 3; level <= finest(); ++level) {
      for (const Overlap& overlap : overlaps) measure_two(level, overlap);
      measure_contact_steps(level);
    }
    if (!result_.interrupted) progress_(1, "");
    return std::move(result_);
  }

 private:
  [[nodiscard]] int finest() const { return quick_ ? finest_quick_level : finest_level; }
  [[nodiscard]] int parts() const { return (finest() - 2) * (static_cast<int>(overlaps.size()) + 1) + !places_of_many_.empty(); }
  // Returns whether the suite goes on.
  bool tell(const std::string& next) {
    if (!result_.interrupted) result_.interrupted = !progress_(double(done_) / parts(), next);
    return !result_.interrupted;
  }

  void measure_many() {
    Case what(many_spheres, overlaps[1], finest(), quick_);
    const std::string name = fmt::format("{} bodies of {} triangles", many_spheres, what.triangles());
    for (const Place& place : places_of_many_)
      if (tell(fmt::format("{}, {}", name, name_of(place)))) what.add(what.open_device(place), place, searches().front());
    let_take_turns(what, name);
  }

  void measure_two(int level, const Overlap& overlap) {
    if (result_.interrupted) return;
    Case what(2, overlap, level, quick_);
    const std::string name = fmt::format("{} triangles each, {}", what.triangles(), overlap.name);
    for (const Place& place : places_) {
      Device& device = what.open_device(place);
      for (const Search& search : searches_of(what, quick_))
        if (tell(fmt::format("{}, {}, {}", name, search.name, name_of(place)))) what.add(device, place, search);
    }
    for (const TreeLibrary& library : libraries_)
      if (tell(fmt::format("{}, {}", name, library.name))) what.add(library);
    let_take_turns(what, name);
  }

  void let_take_turns(Case& what, const std::string& name) {
    for (int turn = 0; turn < what.turn_count(); ++turn) {
      if (!tell(name)) return;
      what.take_turns();
    }
    std::ranges::move(what.rows(), std::back_inserter(result_.rows));
    ++done_;
  }

  void measure_contact_steps(int level) {
    for (const Place& place : places_)
      if (tell(fmt::format("a step in contact, icosphere:{}, {}", level, name_of(place))))
        result_.contact_steps.push_back(measure_contact_step(place, level, quick_));
    ++done_;
  }

  bool quick_;
  const Progress& progress_;
  std::vector<Place> places_, places_of_many_;
  std::vector<TreeLibrary> libraries_;
  CollisionResult result_;
  int done_ = 0;
};

}  // namespace

CollisionResult bench_collision(const CollisionOptions& options, const Progress& progress) {
  return Suite(options, progress).run();
}

}  // namespace pliant::bench
