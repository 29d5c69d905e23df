// Draws the bodies from the buffer in which the simulation keeps their world positions, on a studio ground under a key light.
#pragma once
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>

#include "model/model.hpp"
#include "render/camera.hpp"
#include "render/image.hpp"

namespace pliant::render {

/// How finely light is sampled: `reduced` is for renderers in software.
enum class Detail { full, reduced };

/// What can be drawn while somebody watches.
[[nodiscard]] constexpr Detail live_detail(bool is_software) { return is_software ? Detail::reduced : Detail::full; }

struct RenderOptions {
  glm::uvec2 size{1280, 720};  // [pixels]
  CameraDescription camera;
  Coloring coloring = Coloring::body;
  SceneBox scene;                       // lights and shadows are fitted to it; options_for takes where the bodies start
  std::optional<double> ground_height;  // [m]; empty: no ground
  Detail detail = Detail::full;
  /// Depths are cleared for every so many pictures, 1 to 8. More are faster, but then the last bits of a picture depend on which
  /// of them it is.
  int pictures_per_clear = 1;
};

inline constexpr int most_pictures_per_clear = 8;

/// How bodies are drawn; their shadows are always those of surfaces.
enum class Fill { surface, wireframe };

/// What bodies are coloured by in place of strain.
struct Speeds {
  std::uint32_t motions_buffer = 0;  // a GL buffer of doubles, 6 a vertex: displacement, velocity [m/s]
  std::uint32_t first_vertex = 0;    // the model's vertex 0 there
  double top = 1;                    // the end of the colour scale [m/s]
};

/// The options for a scene: its camera, or one that frames the box, and its ground, or one below the box.
[[nodiscard]] RenderOptions options_for(const SceneBox& box, const OutputDescription& output);

/// Likewise for a scene as it starts, in pictures of this size [pixels] that follow one another at once.
[[nodiscard]] RenderOptions live_options(const Model& model, const State& start, OutputDescription output, const glm::uvec2& size,
                                         Detail detail);

/// Hears the name of each pass once it is queued, so that its time can be taken.
using PassObserver = std::function<void(const char* pass)>;

/// Needs a current gl::Context while it lives. Positions never visit the CPU: normals and strains are computed from them on the
/// GPU. A vertex that is not finite takes its triangles out of the picture.
class FrameRenderer {
 public:
  /// Uploads the topology. Throws Error (device) when the GPU has no room for it.
  FrameRenderer(const Model& model, const RenderOptions& options);
  ~FrameRenderer();

  /// Draws into the renderer's own framebuffer. `positions_buffer` is a GL buffer of vec4, xyz the world position [m];
  /// the model's vertex 0 is its element `first_vertex`. Allocates nothing.
  void draw(std::uint32_t positions_buffer, std::uint32_t first_vertex, const PassObserver& after_pass = {});
  /// Waits for the last draw() and reads its picture.
  [[nodiscard]] Image read() const;
  /// Copies the last picture, pixel by pixel, to the bottom left of the window whose context is current.
  void copy_to_window() const;

  /// The lights stay where they are.
  void set_camera(const CameraDescription& camera);
  void set_fill(Fill fill);
  void set_coloring(Coloring coloring);
  /// Of the pictures from here on, over the colouring as set; empty: none.
  void set_speeds(const std::optional<Speeds>& speeds);
  /// Of the pictures from here on [pixels]. Throws Error (device) when there is no room for them.
  void resize(const glm::uvec2& size);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pliant::render
