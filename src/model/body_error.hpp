// The error of a body of a scene.
#pragma once
#include <string>

#include "core/error.hpp"
#include "scene/scene_description.hpp"

namespace pliant {

/// Returns an error of kind input that names the body, and where its scene file describes it.
[[nodiscard]] inline Error body_error(const BodyDescription& body, const std::string& what, const std::string& remedy) {
  const std::string place = body.where.empty() ? "" : body.where + ": ";
  return {ErrorKind::input, place + "body." + body.name, what, remedy};
}

}  // namespace pliant
