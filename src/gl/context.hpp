// An OpenGL 4.5 core context, which EGL makes without a window or which a window has made.
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
  std::int64_t largest_buffer = 0;    // the largest one that a shader can use [bytes]
  std::uint32_t storage_blocks = 0;   // that a compute shader can have
  std::uint32_t multiprocessors = 0;  // each runs at least one work group at a time. 0 if the driver does not tell
  std::uint64_t free_memory = 0;      // of its own, when the context was made [bytes]. 0 if the driver does not tell
};

/// Returns every EGL device that gives an OpenGL 4.5 core context, hardware first. Asks EGL_EXT_platform_device, then
/// EGL_MESA_platform_surfaceless. Never throws. `reason` says why nothing, or not everything, was found.
[[nodiscard]] std::vector<Adapter> list_adapters(std::string* reason = nullptr);

/// How to reach an OpenGL 4.5 core context that a window made.
struct WindowContext {
  using Function = void (*)();
  Function (*find)(const char* name) = nullptr;  // OpenGL's function of that name
  std::function<void()> make_current;
};

/// Makes its context current on the constructing thread and keeps it until destroyed. Debug output is on. If the driver reports
/// an API error or undefined behaviour, the program ends with its message, because that is a bug in pliant.
class Context {
 public:
  /// Opens adapter `index` of list_adapters(). Throws Error (device) with a remedy.
  explicit Context(int index);
  /// Adopts a window's context. The window must outlive this. The adapter index is -1, because list_adapters() knows nothing of
  /// the context. Do not call list_adapters() while it is current: EGL cannot put back a context that it did not make. Throws
  /// Error (device).
  explicit Context(WindowContext window);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  [[nodiscard]] const Adapter& adapter() const;
  /// Takes no time if it is current already. Throws Error (device) on another thread than that which made it.
  void make_current();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pliant::gl
