// An OpenGL 4.5 core context: without a window, through EGL, or a window's own.
#pragma once
#include <cstdint>
#include <functional>
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
  std::uint32_t storage_blocks = 0;   // that a compute shader can have
  std::uint32_t multiprocessors = 0;  // each runs at least one work group at a time; 0: the driver does not tell
};

/// Every EGL device (EGL_EXT_platform_device, then EGL_MESA_platform_surfaceless) that gives an OpenGL 4.5 core context;
/// hardware first. Never throws; an empty list says why in `reason`.
[[nodiscard]] std::vector<Adapter> list_adapters(std::string* reason = nullptr);

/// How to reach a context that a window made, for OpenGL 4.5 core.
struct WindowContext {
  using Function = void (*)();
  Function (*find)(const char* name) = nullptr;  // OpenGL's function of that name
  std::function<void()> make_current;
};

/// Makes its context current on the constructing thread and keeps it until destroyed. Debug output is on: an API error
/// or an undefined behaviour reported by the driver ends the program with the message (a bug in pliant).
class Context {
 public:
  /// Opens adapter `index` of list_adapters(). Throws Error (device) with a remedy.
  explicit Context(int index);
  /// Adopts a window's context; the window must outlive this. It has adapter index -1, since list_adapters() knows nothing of it
  /// and must not be called while it is current: EGL cannot put back what is not its own. Throws Error (device).
  explicit Context(WindowContext window);
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
