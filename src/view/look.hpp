// The values that a picture of a session depends on.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>

#include "scene/scene_description.hpp"

namespace pliant::view {

enum class Colors { body, deformation, speed };

/// How bodies are drawn, and what is drawn over them.
struct Shows {
  bool wireframe = false;
  Colors colors = Colors::body;
  bool velocities = false, contacts = false;
  std::optional<unsigned> tree_level;  // level whose boxes are drawn, 0 for the root; empty: no boxes

  bool operator==(const Shows&) const = default;
};

struct Look {
  std::uint64_t step = 0;
  CameraDescription camera;
  glm::uvec2 size{0};  // [pixels]
  Shows shows;
  std::uint64_t bodies_version = 0;  // of the session

  bool operator==(const Look&) const = default;
};

}  // namespace pliant::view
