// The passes of one picture: shadow map, footprints on the ground, the ground's light, backdrop, bodies, resolve.
#include "render/frame_renderer.hpp"

#include <glad/gl.h>

#include <algorithm>
#include <bit>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <span>

#include "../../shaders/render/studio.glsl"
#include "core/error.hpp"
#include "core/expect.hpp"
#include "gl/targets.hpp"
#include "render/surface_topology.hpp"

namespace pliant::render {
namespace {

constexpr std::uint32_t shadow_size = 1024, footprint_size = 512, ground_light_size = 320;  // [texels] a side
constexpr int sample_count = 4;
// Uniform locations in the shaders.
constexpr GLint first_vertex_location = 0, direction_location = 1, shows_strain_location = 2;

void require_vertex_storage() {
  GLint blocks = 0;
  glGetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &blocks);
  if (blocks >= 5) return;
  throw Error(ErrorKind::device, "", "this OpenGL driver has too few storage buffers in vertex shaders (5 are needed)",
              "update the driver, choose another --gpu, or leave out --frames png");
}

template <class T>
gl::Buffer upload(const std::vector<T>& data, std::string_view label) {
  gl::Buffer buffer(data.size() * sizeof(T), label);
  buffer.write(0, std::as_bytes(std::span(data)));
  return buffer;
}

std::vector<glm::vec4> colors_of(const Model& model) {
  std::vector<glm::vec4> colors;
  for (const ModelBody& body : model.bodies) colors.emplace_back(glm::vec3(body.color), 1.0f);
  return colors;
}

/// The model's part that never changes, on the GPU.
struct Surface {
  explicit Surface(const Model& model) : Surface(model, incident_triangles(model.vertex_count(), model.triangles)) {}
  Surface(const Model& model, const IncidentTriangles& around)
      : indices(upload(model.triangles, "triangle corners")),
        rest(upload(model.rest_positions, "rest positions for drawing")),
        first_incident(upload(around.first, "first incident triangle")),
        incident(upload(around.others, "incident triangles")),
        colors(upload(colors_of(model), "body colours")),
        vertices(&indices),
        index_count(static_cast<GLsizei>(model.triangles.size() * 3)) {}

  gl::Buffer indices, rest, first_incident, incident, colors;
  gl::VertexArray vertices;
  GLsizei index_count;
};

struct Programs {
  gl::Program shadow = gl::Program::graphics("render/shadow.vert", "render/shadow.frag");
  gl::Program footprint = gl::Program::graphics("render/footprint.vert", "render/footprint.frag");
  gl::Program ground_light = gl::Program::graphics("render/fullscreen.vert", "render/ground_light.frag");
  gl::Program backdrop = gl::Program::graphics("render/fullscreen.vert", "render/backdrop.frag");
  gl::Program body = gl::Program::graphics("render/body.vert", "render/body.frag");
};

gl::TextureOptions square(GLenum format, std::uint32_t side) { return {.format = format, .size = {side, side}}; }

gl::TextureOptions shadow_options() {
  gl::TextureOptions options = square(GL_DEPTH_COMPONENT32F, shadow_size);
  options.compares_depth = true;
  return options;
}

gl::TextureOptions footprint_options() {
  gl::TextureOptions options = square(GL_RG16F, footprint_size);
  options.levels = std::bit_width(footprint_size);
  return options;
}

/// What depends on no size: the maps of light and shadow.
struct Maps {
  gl::Texture shadow{shadow_options(), "shadow map"};
  gl::Texture key_footprint{footprint_options(), "footprint along the key light"};
  gl::Texture above_footprint{footprint_options(), "footprint from above"};
  gl::Texture ground_light{square(GL_RG16F, ground_light_size), "light on the ground"};
  gl::Framebuffer shadow_target{nullptr, &shadow, "shadow map"};
  gl::Framebuffer key_footprint_target{&key_footprint, nullptr, "footprint along the key light"};
  gl::Framebuffer above_footprint_target{&above_footprint, nullptr, "footprint from above"};
  gl::Framebuffer ground_light_target{&ground_light, nullptr, "light on the ground"};
};

struct Picture {
  explicit Picture(const glm::uvec2& size)
      : color({.format = GL_SRGB8_ALPHA8, .size = size, .samples = sample_count}, "samples"),
        depth({.format = GL_DEPTH_COMPONENT32F, .size = size, .samples = sample_count}, "depth samples"),
        resolved({.format = GL_SRGB8_ALPHA8, .size = size}, "picture"),
        samples_target(&color, &depth, "samples"),
        resolved_target(&resolved, nullptr, "picture") {}

  gl::Texture color, depth, resolved;
  gl::Framebuffer samples_target, resolved_target;
};

/// The light stands behind the camera's left shoulder.
glm::dvec3 key_direction_for(const CameraDescription& camera) {
  glm::dvec3 back = camera.eye - camera.target;
  back.y = 0;
  back = glm::length(back) > 0 ? glm::normalize(back) : glm::dvec3(0, 0, 1);
  const glm::dvec3 right = glm::cross(glm::dvec3(0, 1, 0), back);
  return glm::normalize(-0.55 * right + glm::dvec3(0, 1.15, 0) + 0.55 * back);
}

glm::mat4 key_projection_for(const SceneBox& scene, const glm::dvec3& direction) {
  const double r = 1.15 * scene.radius();
  const glm::dmat4 view = glm::lookAt(scene.centre() + direction * (2 * r), scene.centre(), glm::dvec3(0, 1, 0));
  return glm::mat4(glm::ortho(-r, r, -r, r, 0.5 * r, 3.5 * r) * view);
}

Studio studio_for(const RenderOptions& options) {
  const SceneBox& scene = options.scene;
  const glm::dvec3 centre = scene.centre(), key = key_direction_for(options.camera);
  Studio studio{};
  studio.key_projection = key_projection_for(scene, key);
  studio.key_direction = glm::vec4(key, 0.0);
  studio.centre = glm::vec4(centre, scene.radius());
  if (!options.ground_height) return studio;
  // The map of the ground lies under the scene and reaches out to where its shadows fall.
  const glm::dvec3 away = -key * ((centre.y - *options.ground_height) / key.y);
  studio.ground = glm::vec4(centre.x + 0.5 * away.x, *options.ground_height, centre.z + 0.5 * away.z, 2.2 * scene.radius());
  return studio;
}

}  // namespace

struct FrameRenderer::Impl {
  Impl(const Model& model, const RenderOptions& render_options)
      : options(render_options),
        studio(studio_for(render_options)),
        surface(model),
        picture(std::in_place, render_options.size) {}

  void upload_camera();
  void bind_bodies(std::uint32_t positions_buffer, std::uint32_t first_vertex) const;
  void draw_bodies(const gl::Program& program) const;
  void draw_fullscreen(const gl::Program& program) const;
  void draw_shadow_map() const;
  void draw_footprint(const gl::Framebuffer& target, const gl::Texture& map, const glm::vec3& direction) const;
  void draw_ground_light() const;
  void draw_picture() const;
  void resolve() const;

  RenderOptions options;
  Studio studio;
  gl::Buffer studio_buffer{sizeof(Studio), "studio"};
  Programs programs;
  Surface surface;
  gl::VertexArray no_vertices{nullptr};
  Maps maps;
  std::optional<Picture> picture;  // empty only while it is replaced
  Fill fill = Fill::surface;
};

void FrameRenderer::Impl::upload_camera() {
  const CameraDescription& camera = options.camera;
  const double aspect = static_cast<double>(options.size.x) / options.size.y;
  const glm::dmat4 to_clip = view_projection(camera, aspect);
  studio.view_projection = glm::mat4(to_clip);
  studio.from_clip = glm::mat4(glm::inverse(to_clip));
  studio.eye = glm::vec4(camera.eye, 1.0);
  studio_buffer.write(0, std::as_bytes(std::span(&studio, 1)));
}

void FrameRenderer::Impl::bind_bodies(std::uint32_t positions_buffer, std::uint32_t first_vertex) const {
  const std::uint32_t buffers[] = {positions_buffer, surface.rest.id(), surface.first_incident.id(), surface.incident.id(),
                                   surface.colors.id()};
  glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, 5, buffers);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, studio_buffer.id());
  for (const gl::Program* program : {&programs.shadow, &programs.footprint, &programs.body}) {
    glProgramUniform1ui(program->id(), first_vertex_location, first_vertex);
  }
}

void FrameRenderer::Impl::draw_bodies(const gl::Program& program) const {
  glUseProgram(program.id());
  glBindVertexArray(surface.vertices.id());
  glDrawElements(GL_TRIANGLES, surface.index_count, GL_UNSIGNED_INT, nullptr);
}

void FrameRenderer::Impl::draw_fullscreen(const gl::Program& program) const {
  glUseProgram(program.id());
  glBindVertexArray(no_vertices.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void FrameRenderer::Impl::draw_shadow_map() const {
  constexpr GLfloat far_depth = 1;
  maps.shadow_target.bind();
  glClearBufferfv(GL_DEPTH, 0, &far_depth);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_DEPTH_CLAMP);  // a body beyond the light's box still casts its shadow
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(2.5f, 4.0f);
  draw_bodies(programs.shadow);
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisable(GL_DEPTH_CLAMP);
  glDisable(GL_DEPTH_TEST);
}

void FrameRenderer::Impl::draw_footprint(const gl::Framebuffer& target, const gl::Texture& map,
                                         const glm::vec3& direction) const {
  constexpr GLfloat empty[4] = {};
  target.bind();
  glClearBufferfv(GL_COLOR, 0, empty);
  glEnable(GL_BLEND);
  glBlendEquation(GL_MAX);
  glProgramUniform3fv(programs.footprint.id(), direction_location, 1, &direction.x);
  draw_bodies(programs.footprint);
  glDisable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glGenerateTextureMipmap(map.id());
}

void FrameRenderer::Impl::draw_ground_light() const {
  draw_footprint(maps.key_footprint_target, maps.key_footprint, glm::vec3(studio.key_direction));
  draw_footprint(maps.above_footprint_target, maps.above_footprint, {0, 1, 0});
  maps.ground_light_target.bind();
  glBindTextureUnit(0, maps.key_footprint.id());
  glBindTextureUnit(1, maps.above_footprint.id());
  draw_fullscreen(programs.ground_light);
}

void FrameRenderer::Impl::draw_picture() const {
  constexpr GLfloat far_depth = 1;
  picture->samples_target.bind();
  glClearBufferfv(GL_DEPTH, 0, &far_depth);
  glBindTextureUnit(0, maps.ground_light.id());
  glBindTextureUnit(1, maps.shadow.id());
  glEnable(GL_FRAMEBUFFER_SRGB);
  draw_fullscreen(programs.backdrop);
  glEnable(GL_DEPTH_TEST);
  if (fill == Fill::wireframe) glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  draw_bodies(programs.body);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glDisable(GL_DEPTH_TEST);
}

/// Averages the samples in linear light.
void FrameRenderer::Impl::resolve() const {
  const auto w = static_cast<GLint>(options.size.x), h = static_cast<GLint>(options.size.y);
  glBlitNamedFramebuffer(picture->samples_target.id(), picture->resolved_target.id(), 0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT,
                         GL_NEAREST);
  glDisable(GL_FRAMEBUFFER_SRGB);
}

RenderOptions options_for(const SceneBox& box, const OutputDescription& output) {
  RenderOptions options;
  options.size = output.size;
  options.camera = output.camera ? *output.camera : frame_scene(box, static_cast<double>(output.size.x) / output.size.y);
  options.coloring = output.coloring;
  options.scene = box;
  options.ground_height = ground_below(box);
  return options;
}

FrameRenderer::FrameRenderer(const Model& model, const RenderOptions& options) {
  PLIANT_EXPECT(options.size.x > 0 && options.size.y > 0);
  require_vertex_storage();
  impl_ = std::make_unique<Impl>(model, options);
  glProgramUniform1i(impl_->programs.body.id(), shows_strain_location, options.coloring == Coloring::deformation);
  set_camera(options.camera);
}

FrameRenderer::~FrameRenderer() = default;

void FrameRenderer::set_camera(const CameraDescription& camera) {
  impl_->options.camera = camera;
  impl_->upload_camera();
}

void FrameRenderer::set_fill(Fill fill) { impl_->fill = fill; }

void FrameRenderer::resize(const glm::uvec2& size) {
  PLIANT_EXPECT(size.x > 0 && size.y > 0);
  if (size == impl_->options.size) return;
  impl_->picture.reset();
  impl_->picture.emplace(size);
  impl_->options.size = size;
  impl_->upload_camera();
}

void FrameRenderer::draw(std::uint32_t positions_buffer, std::uint32_t first_vertex) {
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  impl_->bind_bodies(positions_buffer, first_vertex);
  glEnable(GL_CLIP_DISTANCE0);
  impl_->draw_shadow_map();
  if (impl_->studio.ground.w > 0) impl_->draw_ground_light();
  impl_->draw_picture();
  glDisable(GL_CLIP_DISTANCE0);
  impl_->resolve();
  glUseProgram(0);  // a program left current would be checked against textures that are bound or deleted later
}

void FrameRenderer::copy_to_window() const {
  const auto w = static_cast<GLint>(impl_->options.size.x), h = static_cast<GLint>(impl_->options.size.y);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, w, h);  // where Mesa looks whether the window has been resized
  glBlitNamedFramebuffer(impl_->picture->resolved_target.id(), 0, 0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

Image FrameRenderer::read() const {
  const glm::uvec2 size = impl_->options.size;
  Image image{size.x, size.y, std::vector<std::uint8_t>(std::size_t{3} * size.x * size.y)};
  glBindFramebuffer(GL_READ_FRAMEBUFFER, impl_->picture->resolved_target.id());
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
