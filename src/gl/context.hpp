// An OpenGL 4.5 core context without a window, through EGL.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pliant::gl {

struct Adapter {
  int index = 0;         // as in --gpu N
  std::string renderer;  // GL_RENDERER
  std::string vendor, version;
  bool is_software = false;           // llvmpipe, softpipe, swrast
  std::int64_t largest_buffer = 0;    // that a shader can use [bytes]
  std::uint32_t multiprocessors = 0;  // each runs at least one work group at a time; 0: the driver does not tell
};

/// Every EGL device (EGL_EXT_platform_device, then EGL_MESA_platform_surfaceless) that gives an OpenGL 4.5 core context;
/// hardware first. Never throws; an empty list says why in `reason`.
[[nodiscard]] std::vector<Adapter> list_adapters(std::string* reason = nullptr);

/// Makes its context current on the constructing thread and keeps it until destroyed. Debug output is on: an API error
/// or an undefined behaviour reported by the driver ends the program with the message (a bug in pliant).
class Context {
 public:
  /// Opens adapter `index` of list_adapters(). Throws Error (device) with a remedy.
  explicit Context(int index);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  [[nodiscard]] const Adapter& adapter() const;
  void make_current();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pliant::gl
