#include "run/painter.hpp"

#include <optional>

#include "core/error.hpp"
#include "device/gpu/gpu_device.hpp"
#include "gl/context.hpp"
#include "render/contact_marks.hpp"
#include "render/drawn_buffers.hpp"
#include "render/frame_renderer.hpp"

namespace pliant {
namespace {

render::SceneBox box_of(const PreparedRun& run) { return render::box_around(run.start.state.world_positions(run.start.model)); }

std::unique_ptr<gl::Context> context_for_drawing(const char* asked) {
  std::string reason;
  if (gl::list_adapters(&reason).empty())
    throw Error(ErrorKind::device, asked, "drawing needs OpenGL 4.5: " + reason,
                "install libegl1 and libgl1-mesa-dri, or write obj, ply or vtk frames");
  return std::make_unique<gl::Context>(0);
}

}  // namespace

struct Painter::Impl {
  Impl(PreparedRun& drawn, const OutputDescription& output, const char* asked)
      : run(drawn),
        marks(output.marks),
        own_context(gpu::context_of(*drawn.device) == nullptr ? context_for_drawing(asked) : nullptr),
        context(own_context ? *own_context : *gpu::context_of(*drawn.device)) {
    context.make_current();
    buffers.emplace();
    renderer.emplace(drawn.start.model, render::options_for(box_of(drawn), output));
  }
  ~Impl() { context.make_current(); }

  render::Lines contacts() {
    render::Lines lines;
    const Model& model = run.start.model;
    render::add_contacts(lines, *run.simulation, model, run.simulation->state().world_positions(model));
    return lines;
  }

  PreparedRun& run;
  Marks marks;
  std::unique_ptr<gl::Context> own_context;
  gl::Context& context;
  std::optional<render::DrawnBuffers> buffers;
  std::optional<render::FrameRenderer> renderer;
};

Painter::Painter(PreparedRun& run, const OutputDescription& output, const char* asked)
    : impl_(std::make_unique<Impl>(run, output, asked)) {}

Painter::~Painter() = default;

render::Image Painter::paint() {
  Impl& with = *impl_;
  with.context.make_current();
  const render::DrawnBuffer positions = with.buffers->positions(*with.run.device, *with.run.simulation);
  with.renderer->draw(positions.id, positions.first_vertex);
  if (with.marks == Marks::contacts) with.renderer->draw_lines(with.contacts());
  return with.renderer->read();
}

}  // namespace pliant
