// Draws the bodies on a studio ground under a key light. It reads the buffer in which the simulation keeps their world positions.
#pragma once
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <span>

#include "model/model.hpp"
#include "render/camera.hpp"
#include "render/image.hpp"
#include "render/line_overlay.hpp"

namespace pliant::render {

/// How finely light is sampled. `reduced` is for renderers in software.
enum class Detail { full, reduced };

/// Returns the detail that is fast enough for a window.
[[nodiscard]] constexpr Detail live_detail(bool is_software) { return is_software ? Detail::reduced : Detail::full; }

struct RenderOptions {
  glm::uvec2 size{1280, 720};  // [pixels]
  CameraDescription camera;
  Coloring coloring = Coloring::body;
  SceneBox scene;                       // in which bodies start. Lights and shadows are fitted to it while bodies fill it
  std::optional<double> ground_height;  // [m]; empty: no ground
  Detail detail = Detail::full;
  /// How many pictures share one clearing of the depths, 1 to 8. More are faster, but then the last bits of a picture depend on
  /// its place among them.
  int pictures_per_clear = 1;
};

inline constexpr int most_pictures_per_clear = 8;

/// How bodies are drawn. Their shadows are always those of surfaces.
enum class Fill { surface, wireframe };

/// The speeds that colour bodies instead of strain.
struct Speeds {
  std::uint32_t motions_buffer = 0;  // a GL buffer of doubles, 6 a vertex: displacement [m], velocity [m/s]
  std::uint32_t first_vertex = 0;    // index of the model's vertex 0 in it
  double top = 1;                    // the end of the colour scale [m/s]
};

/// Returns the options for a scene whose bodies start in `box`. A scene without a camera gets one that frames the box, and a
/// scene without a ground height gets a ground below the box.
[[nodiscard]] RenderOptions options_for(const SceneBox& box, const OutputDescription& output);

/// Returns the options for a window of `size` [pixels]. The box is that of the bodies in `start`, and pictures share clearings of
/// the depths.
[[nodiscard]] RenderOptions live_options(const Model& model, const State& start, OutputDescription output, const glm::uvec2& size,
                                         Detail detail);

/// Is called with the name of each pass after the pass is queued, so that a caller can time it.
using PassObserver = std::function<void(const char* pass)>;

/// Needs a current gl::Context while it lives. Positions stay on the GPU, which computes normals and strains from them. Triangles
/// with a vertex that is not finite are not drawn.
class FrameRenderer {
 public:
  /// Uploads the topology. Throws Error (device) when the GPU has no room for it.
  FrameRenderer(const Model& model, const RenderOptions& options);
  ~FrameRenderer();

  /// Draws into the renderer's own framebuffer. `positions_buffer` is a GL buffer of vec4, whose xyz is the world position [m].
  /// The model's vertex 0 is its element `first_vertex`. Allocates nothing.
  void draw(std::uint32_t positions_buffer, std::uint32_t first_vertex, const PassObserver& after_pass = {});
  /// Draws lines over the last picture.
  void draw_lines(std::span<const LineEnd> ends);
  /// Waits for the last draw() and reads its picture.
  [[nodiscard]] Image read() const;
  /// Returns the OpenGL texture of the last picture, until the size changes. Its first row is the lowest.
  [[nodiscard]] std::uint32_t picture_texture() const;
  /// Copies the last picture, pixel by pixel, to the bottom left of the window whose context is current.
  void copy_to_window() const;

  /// Changes the camera. The light comes from where it came from.
  void set_camera(const CameraDescription& camera);
  /// Draws these bodies from now on. The light comes from where it came from.
  void set_bodies(const Model& model);
  void set_fill(Fill fill);
  void set_coloring(Coloring coloring);
  /// Colours later pictures by speed instead of the colouring that was set. If empty, that colouring applies again.
  void set_speeds(const std::optional<Speeds>& speeds);
  /// Sets the size of later pictures [pixels]. Throws Error (device) when there is no room for them.
  void resize(const glm::uvec2& size);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pliant::render
