// A picture has these passes: what is lit, smooth normals, shadow map, light on the ground, what each sample sees, occlusion,
// shading. Rasterisation only finds out what is seen. Compute shaders compute all light, once a pixel.
#include "render/frame_renderer.hpp"

#include <glad/gl.h>

#include <algorithm>
#include <bit>
#include <span>
#include <string>

#include "core/expect.hpp"
#include "gl/targets.hpp"
#include "render/drawn_surface.hpp"
#include "render/studio.hpp"

namespace pliant::render {
namespace {

constexpr std::uint32_t shadow_size = 1024, footprint_size = 256;  // [texels] a side
constexpr std::uint32_t tile = 8, vertices_of_group = 64;          // pixels a side, and vertices, of a work group
constexpr GLfloat far_depth = 1;
// Uniform locations in the shaders.
constexpr GLint view_location = 0, first_vertex_location = 0, vertex_count_location = 1, shows_strain_location = 1,
                first_motion_location = 2, strain_of_speed_location = 3, depth_slice_location = 2, shadow_slice_location = 3,
                hides_insides_location = 4;
constexpr GLuint camera_view = 0, light_view = 1, view_from_above = 2;  // of place.vert

/// Boxes around nothing, as place_maps.comp leaves them behind.
std::vector<std::uint32_t> no_bounds() { return {~0u, ~0u, ~0u, 0, 0, 0, ~0u, ~0u, ~0u, 0, 0, 0}; }

/// What a level of detail means for the shaders.
struct Sampling {
  std::uint32_t ground_light_size;       // [texels] a side
  int shadow_blocker_taps, shadow_taps;  // on bodies, of four texels each
  bool inner_outlines;                   // also smooths outlines before other surfaces, not only before the backdrop
};

Sampling sampling_of(Detail detail) { return detail == Detail::full ? Sampling{256, 12, 16, true} : Sampling{128, 4, 4, false}; }

std::vector<gl::Define> defines_of(const Sampling& sampling) {
  return {{"BLOCKER_TAPS", std::to_string(sampling.shadow_blocker_taps)},
          {"SHADOW_TAPS", std::to_string(sampling.shadow_taps)},
          {"INNER_OUTLINES", sampling.inner_outlines ? "true" : "false"}};
}

struct Programs {
  explicit Programs(const Sampling& sampling) : picture(gl::Program::compute("render/picture.comp", defines_of(sampling))) {}

  gl::Program bound_vertices = gl::Program::compute("render/bound_vertices.comp");
  gl::Program place_maps = gl::Program::compute("render/place_maps.comp");
  gl::Program smooth_surface = gl::Program::compute("render/smooth_surface.comp");
  gl::Program shadow = gl::Program::graphics("render/place.vert", "render/shadow.frag");
  gl::Program footprint = gl::Program::graphics("render/place.vert", "render/footprint.frag");
  gl::Program ground_light = gl::Program::compute("render/ground_light.comp");
  gl::Program seen = gl::Program::graphics("render/place.vert", "render/seen.frag");
  gl::Program occlusion = gl::Program::compute("render/occlusion.comp");
  gl::Program mean = gl::Program::compute("render/mean.comp");
  gl::Program picture;
};

/// Clearing all depths can take a GPU as long as drawing, so pictures share one clearing. Each picture uses a slice of the depths
/// in front of the slice of the picture before. All slices lie above a half, where floats are equally far apart.
class DepthSlices {
 public:
  explicit DepthSlices(int pictures_per_clear) : pictures_per_clear_(pictures_per_clear) {}

  /// Returns where the next picture's slice begins, and its width. If no slice is left, clears the depths of the bound target.
  glm::vec2 next() {
    if (left_ == 0) {
      glClearBufferfv(GL_DEPTH, 0, &far_depth);
      left_ = pictures_per_clear_;
    }
    const int slice = --left_ + most_pictures_per_clear - pictures_per_clear_;  // the farthest first
    return {0.5f + width * static_cast<float>(slice), width};
  }

 private:
  static constexpr float width = 0.5f / most_pictures_per_clear;
  int pictures_per_clear_, left_ = 0;
};

void set_depth_range(const glm::vec2& slice) { glDepthRangef(slice.x, slice.x + slice.y); }

gl::TextureOptions square(GLenum format, std::uint32_t side) { return {.format = format, .size = {side, side}}; }

gl::TextureOptions shadow_options() {
  gl::TextureOptions options = square(GL_DEPTH_COMPONENT32F, shadow_size);
  options.outside = far_depth;
  return options;
}

gl::TextureOptions footprint_options() {
  gl::TextureOptions options = square(GL_RG16F, footprint_size);
  options.levels = std::bit_width(footprint_size);
  return options;
}

gl::TextureOptions ground_light_options(std::uint32_t side) {
  gl::TextureOptions options = square(GL_RG16, side);
  options.levels = std::bit_width(side);
  options.blends_levels = true;
  options.outside = 1;  // all light arrives
  return options;
}

/// The maps of light and shadow. They do not depend on the picture's size.
struct Maps {
  Maps(const Sampling& sampling, int pictures_per_clear)
      : shadow_slices(pictures_per_clear),
        ground_light(square(GL_RG16, sampling.ground_light_size), "light on the ground"),
        mean_ground_light(ground_light_options(sampling.ground_light_size), "mean light on the ground") {}

  gl::Texture shadow{shadow_options(), "shadow map"};
  DepthSlices shadow_slices;
  gl::Texture footprint{footprint_options(), "footprint from above"};
  gl::Texture ground_light, mean_ground_light;
  gl::Framebuffer shadow_target{nullptr, &shadow, "shadow map"};
  gl::Framebuffer footprint_target{&footprint, nullptr, "footprint from above"};
};

struct Picture {
  Picture(const glm::uvec2& size, int pictures_per_clear)
      : slices(pictures_per_clear),
        seen({.format = GL_R32UI, .size = size, .samples = sample_count}, "triangles seen"),
        depth({.format = GL_DEPTH_COMPONENT32F, .size = size, .samples = sample_count}, "depths"),
        occlusion({.format = GL_RG16, .size = (size + 1u) / 2u}, "occlusion"),
        mean_occlusion({.format = GL_RG16, .size = (size + 1u) / 2u}, "mean occlusion"),
        shaded({.format = GL_RGBA8, .size = size}, "picture"),
        seen_target(&seen, &depth, "triangles seen"),
        shaded_target(&shaded, nullptr, "picture") {}

  DepthSlices slices;
  gl::Texture seen, depth, occlusion, mean_occlusion, shaded;
  gl::Framebuffer seen_target, shaded_target;
};

/// Runs a program with one thread a texel. It waits for readers of what it overwrites. Later passes see the result through
/// textures and framebuffers.
void fill(const gl::Texture& texture, GLenum format, const gl::Program& program) {
  const glm::uvec2 groups = (texture.size() + tile - 1u) / tile;
  glBindImageTexture(0, texture.id(), 0, GL_FALSE, 0, GL_WRITE_ONLY, format);
  glUseProgram(program.id());
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  glDispatchCompute(groups.x, groups.y, 1);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

}  // namespace

struct FrameRenderer::Impl {
  Impl(const Model& model, const RenderOptions& render_options)
      : options(render_options),
        studio(studio_for(render_options)),
        programs(sampling_of(render_options.detail)),
        surface(std::in_place, model),
        maps(sampling_of(render_options.detail), render_options.pictures_per_clear),
        picture(std::in_place, render_options.size, render_options.pictures_per_clear) {}

  void upload_camera();
  void bind_bodies(std::uint32_t positions_buffer, std::uint32_t first_vertex) const;
  void place_maps() const;
  void draw_bodies(const gl::Program& program, GLuint view, GLsizei index_count) const;
  void set_shown() const;
  void smooth_surface() const;
  void draw_shadow_map();
  void draw_footprint() const;
  void average(const gl::Texture& map, const gl::Texture& mean) const;
  void light_ground() const;
  void draw_seen();
  void find_occlusion() const;
  void shade() const;

  RenderOptions options;
  Studio studio;
  gl::Buffer studio_buffer{sizeof(Studio), "studio"}, bounds = gl::buffer_of(no_bounds(), "bounds of vertices");
  Programs programs;
  std::optional<DrawnSurface> surface;  // empty only while it is replaced
  Maps maps;
  std::optional<Picture> picture;  // empty only while it is replaced
  Fill fill_mode = Fill::surface;
  std::optional<Speeds> speeds;
  std::optional<LineOverlay> overlay;  // made for the first lines
};

void FrameRenderer::Impl::upload_camera() {
  see_from(studio, options);
  studio_buffer.write(0, std::as_bytes(std::span(&studio, 1)));
}

void FrameRenderer::Impl::bind_bodies(std::uint32_t positions_buffer, std::uint32_t first_vertex) const {
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  surface->vertices.take_positions(positions_buffer, first_vertex);
  for (const gl::Program* program : {&programs.bound_vertices, &programs.smooth_surface, &programs.occlusion, &programs.picture})
    glProgramUniform1ui(program->id(), first_vertex_location, first_vertex);
  const std::uint32_t positions_and_rest[] = {positions_buffer, surface->rest.id()};
  glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, 2, positions_and_rest);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, studio_buffer.id());
}

// The CPU never reads where they are.
void FrameRenderer::Impl::place_maps() const {
  constexpr std::uint32_t vertices_of_thread = 16;
  const std::uint32_t count = surface->solid_vertex_count, buffers[] = {bounds.id(), studio_buffer.id()};
  glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 2, 2, buffers);
  glProgramUniform1ui(programs.bound_vertices.id(), vertex_count_location, count);
  glUseProgram(programs.bound_vertices.id());
  glDispatchCompute(count / (vertices_of_group * vertices_of_thread) + 1, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  glUseProgram(programs.place_maps.id());
  glDispatchCompute(1, 1, 1);
  glMemoryBarrier(GL_UNIFORM_BARRIER_BIT);
}

void FrameRenderer::Impl::draw_bodies(const gl::Program& program, GLuint view, GLsizei index_count) const {
  glProgramUniform1ui(program.id(), view_location, view);
  glUseProgram(program.id());
  glBindVertexArray(surface->vertices.id());
  glEnable(GL_CLIP_DISTANCE0);
  glDrawElements(GL_TRIANGLES, index_count, GL_UNSIGNED_INT, nullptr);
  glDisable(GL_CLIP_DISTANCE0);
}

void FrameRenderer::Impl::set_shown() const {
  const GLuint smooth = programs.smooth_surface.id();
  glProgramUniform1i(programs.picture.id(), shows_strain_location, speeds || options.coloring == Coloring::deformation);
  glProgramUniform1i(programs.picture.id(), hides_insides_location, fill_mode == Fill::surface);
  glProgramUniform1ui(smooth, first_motion_location, speeds ? speeds->first_vertex : 0);
  glProgramUniform1f(smooth, strain_of_speed_location, speeds ? full_strain / static_cast<float>(speeds->top) : 0.0f);
}

void FrameRenderer::Impl::smooth_surface() const {
  const std::uint32_t buffers[] = {surface->first_incident.id(), surface->incident.id(), surface->smooth.id()};
  glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 2, 3, buffers);
  if (speeds) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, speeds->motions_buffer);
  glProgramUniform1ui(programs.smooth_surface.id(), vertex_count_location, surface->vertex_count);
  glUseProgram(programs.smooth_surface.id());
  glDispatchCompute((surface->vertex_count + vertices_of_group - 1) / vertices_of_group, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void FrameRenderer::Impl::draw_shadow_map() {
  maps.shadow_target.bind();
  const glm::vec2 slice = maps.shadow_slices.next();
  for (const gl::Program* program : {&programs.ground_light, &programs.picture})
    glProgramUniform2f(program->id(), shadow_slice_location, slice.x, slice.y);
  set_depth_range(slice);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_DEPTH_CLAMP);  // a body beyond the light's box still casts its shadow
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(2.5f, 4.0f);
  draw_bodies(programs.shadow, light_view, surface->solid_index_count);
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisable(GL_DEPTH_CLAMP);
  glDisable(GL_DEPTH_TEST);
  glDepthRangef(0, 1);
}

void FrameRenderer::Impl::draw_footprint() const {
  constexpr GLfloat nothing[4] = {0, 0, 0, 0};
  maps.footprint_target.bind();
  glClearBufferfv(GL_COLOR, 0, nothing);
  glEnable(GL_BLEND);
  glBlendEquation(GL_MAX);
  draw_bodies(programs.footprint, view_from_above, surface->solid_index_count);
  glDisable(GL_BLEND);
  glGenerateTextureMipmap(maps.footprint.id());
}

void FrameRenderer::Impl::average(const gl::Texture& map, const gl::Texture& mean) const {
  glBindTextureUnit(0, map.id());
  fill(mean, GL_RG16, programs.mean);
}

void FrameRenderer::Impl::light_ground() const {
  glBindTextureUnit(0, maps.shadow.id());
  glBindTextureUnit(1, maps.footprint.id());
  fill(maps.ground_light, GL_RG16, programs.ground_light);
  average(maps.ground_light, maps.mean_ground_light);
  glGenerateTextureMipmap(maps.mean_ground_light.id());
}

void FrameRenderer::Impl::draw_seen() {
  picture->seen_target.bind();
  const glm::vec2 slice = picture->slices.next();
  for (const gl::Program* program : {&programs.occlusion, &programs.picture})
    glProgramUniform2f(program->id(), depth_slice_location, slice.x, slice.y);
  set_depth_range(slice);
  glEnable(GL_DEPTH_TEST);
  if (fill_mode == Fill::wireframe) glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  glEnable(GL_CULL_FACE);
  // The sides that face the eye come first, because they hide most others. Of containers the others show alone.
  glCullFace(GL_BACK);
  draw_bodies(programs.seen, camera_view, surface->solid_index_count);
  glCullFace(GL_FRONT);
  draw_bodies(programs.seen, camera_view, surface->index_count);
  glDisable(GL_CULL_FACE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glDisable(GL_DEPTH_TEST);
  glDepthRangef(0, 1);
}

void FrameRenderer::Impl::find_occlusion() const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, surface->indices.id());
  glBindTextureUnit(2, picture->seen.id());
  glBindTextureUnit(4, picture->depth.id());
  fill(picture->occlusion, GL_RG16, programs.occlusion);
  average(picture->occlusion, picture->mean_occlusion);
}

void FrameRenderer::Impl::shade() const {
  const std::uint32_t buffers[] = {surface->colors.id(), surface->smooth.id(), surface->indices.id()};
  glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 3, 3, buffers);
  const std::uint32_t textures[] = {maps.shadow.id(), maps.mean_ground_light.id(), picture->seen.id(),
                                    picture->mean_occlusion.id(), picture->depth.id()};
  glBindTextures(0, 5, textures);
  fill(picture->shaded, GL_RGBA8, programs.picture);
}

RenderOptions options_for(const SceneBox& box, const OutputDescription& output) {
  RenderOptions options;
  options.size = output.size;
  options.camera = output.camera ? *output.camera : frame_scene(box, static_cast<double>(output.size.x) / output.size.y);
  options.coloring = output.coloring;
  options.scene = box;
  options.ground_height = output.ground_height.value_or(ground_below(box));
  return options;
}

RenderOptions live_options(const Model& model, const State& start, OutputDescription output, const glm::uvec2& size,
                           Detail detail) {
  output.size = size;
  RenderOptions options = options_for(box_around(start.world_positions(model)), output);
  options.detail = detail;
  options.pictures_per_clear = most_pictures_per_clear;
  return options;
}

FrameRenderer::FrameRenderer(const Model& model, const RenderOptions& options) {
  PLIANT_EXPECT(options.size.x > 0 && options.size.y > 0);
  PLIANT_EXPECT(options.pictures_per_clear >= 1 && options.pictures_per_clear <= most_pictures_per_clear);
  impl_ = std::make_unique<Impl>(model, options);
  set_coloring(options.coloring);
  set_camera(options.camera);
}

FrameRenderer::~FrameRenderer() = default;

void FrameRenderer::set_camera(const CameraDescription& camera) {
  impl_->options.camera = camera;
  impl_->upload_camera();
}

void FrameRenderer::set_bodies(const Model& model) {
  impl_->surface.reset();
  impl_->surface.emplace(model);
}

void FrameRenderer::set_coloring(Coloring coloring) {
  impl_->options.coloring = coloring;
  impl_->set_shown();
}

void FrameRenderer::set_speeds(const std::optional<Speeds>& speeds) {
  impl_->speeds = speeds;
  impl_->set_shown();
}

void FrameRenderer::set_fill(Fill fill) {
  impl_->fill_mode = fill;
  impl_->set_shown();
}

void FrameRenderer::resize(const glm::uvec2& size) {
  PLIANT_EXPECT(size.x > 0 && size.y > 0);
  if (size == impl_->options.size) return;
  impl_->picture.reset();
  impl_->picture.emplace(size, impl_->options.pictures_per_clear);
  impl_->options.size = size;
  impl_->upload_camera();
}

void FrameRenderer::draw(std::uint32_t positions_buffer, std::uint32_t first_vertex, const PassObserver& after_pass) {
  const auto tell = [&](const char* pass) {
    if (after_pass) after_pass(pass);
  };
  impl_->bind_bodies(positions_buffer, first_vertex);
  impl_->place_maps();
  impl_->smooth_surface();
  tell("normals");
  impl_->draw_shadow_map();
  tell("shadow");
  if (impl_->options.ground_height) {
    impl_->draw_footprint();
    impl_->light_ground();
  }
  tell("ground");
  impl_->draw_seen();
  tell("seen");
  impl_->find_occlusion();
  tell("occlusion");
  impl_->shade();
  tell("shading");
  glUseProgram(0);  // else drivers check the program against textures that are bound or deleted later
}

void FrameRenderer::draw_lines(std::span<const LineEnd> ends) {
  if (ends.empty()) return;
  if (!impl_->overlay) impl_->overlay.emplace();
  impl_->picture->shaded_target.bind();
  impl_->overlay->draw(ends, impl_->options.camera, impl_->options.size);
}

std::uint32_t FrameRenderer::picture_texture() const { return impl_->picture->shaded.id(); }

void FrameRenderer::copy_to_window() const {
  const auto w = static_cast<GLint>(impl_->options.size.x), h = static_cast<GLint>(impl_->options.size.y);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, w, h);  // in this call Mesa checks whether the window has been resized
  glBlitNamedFramebuffer(impl_->picture->shaded_target.id(), 0, 0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

Image FrameRenderer::read() const {
  const glm::uvec2 size = impl_->options.size;
  Image image{size.x, size.y, std::vector<std::uint8_t>(std::size_t{3} * size.x * size.y)};
  glBindFramebuffer(GL_READ_FRAMEBUFFER, impl_->picture->shaded_target.id());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, static_cast<GLsizei>(size.x), static_cast<GLsizei>(size.y), GL_RGB, GL_UNSIGNED_BYTE, image.pixels.data());
  const std::size_t row = std::size_t{3} * size.x;
  for (std::size_t top = 0, bottom = size.y - 1; top < bottom; ++top, --bottom) {  // OpenGL's first row is the lowest
    const auto first = image.pixels.begin() + static_cast<std::ptrdiff_t>(top * row);
    std::swap_ranges(first, first + static_cast<std::ptrdiff_t>(row),
                     image.pixels.begin() + static_cast<std::ptrdiff_t>(bottom * row));
  }
  return image;
}

}  // namespace pliant::render
