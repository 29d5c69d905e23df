// Draws a run's bodies as they are.
#pragma once
#include <memory>

#include "render/image.hpp"
#include "run/prepared_run.hpp"

namespace pliant {

/// Draws on the GPU device's context. For a CPU device it makes a context of its own. Only the thread that made it may use it.
class Painter {
 public:
  /// `run` must outlive it. `asked` says what drawing is needed for, as the place of an error. Throws Error (device) where
  /// there is no OpenGL.
  Painter(PreparedRun& run, const OutputDescription& output, const char* asked);
  ~Painter();
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  [[nodiscard]] render::Image paint();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pliant
