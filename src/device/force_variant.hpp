// The ways of summing springs that a device knows, and which of them is the fastest.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace pliant {

/// One way of summing springs. Its name says how. No two have the same.
struct ForceVariant {
  static constexpr std::uint32_t any_number = 0xffffffffu;

  std::string name;
  std::uint32_t share_size = 0;     // vertices that one item of a force kernel serves, at most
  bool all_stages = false;          // whether its kernels can run every stage of a step in one dispatch
  std::uint32_t quiet_groups = 0;   // work groups that make quiet steps together, at most; 0: it makes none
  std::uint32_t lanes = 1;          // threads that share a vertex's springs
  bool cancels_rounding = true;     // whether stages take off what those before have rounded (kernels/runge_kutta_stage.glsl)
  std::uint32_t most_vertices = 0;  // of all bodies together, up to which it is the fastest; 0: another one always is
  std::uint32_t smallest_body = 1, largest_body = any_number;  // in vertices: for others another one is always faster

  [[nodiscard]] bool suits(std::uint32_t vertices_of_body) const {
    return smallest_body <= vertices_of_body && vertices_of_body <= largest_body;
  }
};

/// Returns the place of the fastest variant for a body of so many vertices, if the kernel serves so many in all.
[[nodiscard]] std::size_t fastest_force_variant(std::span<const ForceVariant> variants, std::uint32_t vertices_in_all,
                                                std::uint32_t vertices_of_body);

}  // namespace pliant
