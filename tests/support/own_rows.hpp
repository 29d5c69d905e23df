// A force and a response of the tests' own: a file and a row each.
#pragma once
#include <span>
#include <string_view>

#include "gl/shader_source.hpp"
#include "scene/scene_description.hpp"

namespace pliant {

inline constexpr double chain_stiffness = 5;  // [N/m]

/// Adds the force "chain", which acts on a body named "chained", and the response "halt". Later calls add nothing.
void add_own_rows();
/// The kernels of these rows.
[[nodiscard]] std::span<const gl::ShaderFile> own_kernel_files();
/// Adds a kernel "misread", whose view of an array does not fit. Later calls add nothing.
void add_misread_kernel();

/// A body on which a force of the list acts.
struct ForceExample {
  std::string_view force;  // the row's name
  std::string_view name;
  void (*set)(BodyDescription& body);  // `body` has no force before
};
/// Every row of forces() needs an example here, or several. The contract tests then take the row up.
[[nodiscard]] std::span<const ForceExample> force_examples();

}  // namespace pliant
