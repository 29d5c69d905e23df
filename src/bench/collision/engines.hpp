// What searches a case of the suite `collision`: pliant in several ways, and other libraries.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bench/collision/tree_peers.hpp"
#include "collision/collider.hpp"

namespace pliant::bench {

struct Found {
  std::uint64_t pairs = 0;    // of triangles that touch
  std::vector<bool> touched;  // vertices

  bool operator==(const Found&) const = default;
};

/// Of one round, which refits all trees and finds all pairs.
struct RoundSeconds {
  double refit, query;
};

class Engine {
 public:
  virtual ~Engine() = default;
  [[nodiscard]] virtual double build_seconds() const = 0;  // 0 without trees
  /// Reads where vertices stand now. Has to come before the first round, and is no part of one.
  virtual void read_places() = 0;
  /// Makes a round and returns what it found.
  [[nodiscard]] virtual Found find() = 0;
  /// Makes as many rounds as are timed well together.
  virtual std::vector<RoundSeconds> make_rounds() = 0;
};

/// How pliant searches.
struct Search {
  const char* name;
  ContactSearch method = ContactSearch::tree;
  TreeDescription tree{};
};
/// The first has what is best on a device. The last is brute force.
[[nodiscard]] std::span<const Search> searches();

/// The device, the start and its meshes must outlive the engine.
[[nodiscard]] std::unique_ptr<Engine> make_engine(Device& device, const ModelAndState& start, const TwoMeshes& meshes,
                                                  const Search& search);
/// The meshes and the library must outlive the engine.
[[nodiscard]] std::unique_ptr<Engine> make_engine(const TreeLibrary& library, const TwoMeshes& meshes);

}  // namespace pliant::bench
