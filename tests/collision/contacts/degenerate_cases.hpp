// The hand-made cases of degenerate.json: triangle pairs and cube pairs with their exact answers.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "collision/contacts/exact_triangles.hpp"
#include "model/model.hpp"

namespace pliant::testing {

struct TrianglePair {
  std::string id, category;
  Triangle a, b;
  std::optional<bool> touch;  // empty: a coordinate is NaN or infinite
};

struct CubePair {
  std::string id;
  Model model;                    // two bodies of 12 triangles (the test is about their rest positions)
  std::vector<glm::uvec2> pairs;  // pairs that touch, as indices into the model's triangles, in ascending order
};

[[nodiscard]] std::vector<TrianglePair> triangle_pairs();
[[nodiscard]] std::vector<CubePair> cube_pairs();

/// Calls use(a, b) for the 72 orders of the corners and of the two triangles.
template <class Use>
void for_every_order(const Triangle& a, const Triangle& b, Use use) {
  constexpr std::array<std::array<std::size_t, 3>, 6> orders{{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (const auto& p : orders) {
    for (const auto& q : orders) {
      const Triangle first{a[p[0]], a[p[1]], a[p[2]]}, second{b[q[0]], b[q[1]], b[q[2]]};
      use(first, second);
      use(second, first);
    }
  }
}

}  // namespace pliant::testing
