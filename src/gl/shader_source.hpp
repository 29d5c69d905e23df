// Holds the shader files embedded in the library, and flattens their #include lines.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pliant::gl {

struct ShaderFile {
  std::string_view name;  // path below shaders/, such as "compute/kernels/refit.glsl"
  std::string_view text;
};

[[nodiscard]] std::span<const ShaderFile> embedded_shaders();

/// Name and value of a #define. A name that starts with '@' is a virtual include instead: `#include "@kernel"` reads the file
/// that the value names. A name behind '!' is not defined. #ifdef and #ifndef of names that are defined, or not defined in this
/// way, are decided while flattening: what is left out includes nothing and declares nothing. Others are left to the driver.
using Define = std::pair<std::string, std::string>;

struct FlatShader {
  std::string text;
  struct Origin {
    std::string_view file;
    int line;
  };
  std::vector<Origin> origins;  // of each line of text, from line 1

  /// Replaces the driver's line numbers ("0:12(3)", "0(12)", "ERROR: 0:12") by true file names and lines.
  [[nodiscard]] std::string explain(std::string_view driver_log) const;
};

/// Returns a shader with its includes in place, each file once. Includes are relative to the including file or else to compute/.
/// `#include <...>` is dropped (C++ only). Defines go behind the #version line. Throws Error (device) if a file is missing.
[[nodiscard]] FlatShader flatten_shader(std::string_view file, std::span<const Define> defines = {});
/// Does the same with `files` instead of the embedded ones. The result's origins view their names.
[[nodiscard]] FlatShader flatten_shader(std::span<const ShaderFile> files, std::string_view file,
                                        std::span<const Define> defines = {});

}  // namespace pliant::gl
