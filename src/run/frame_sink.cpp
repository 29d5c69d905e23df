#include "run/frame_sink.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "core/counted.hpp"
#include "device/gpu/gpu_device.hpp"
#include "output/png.hpp"
#include "render/contact_marks.hpp"
#include "render/drawn_buffers.hpp"
#include "render/frame_renderer.hpp"

namespace pliant {
namespace {

render::SceneBox box_of(const PreparedRun& run) { return render::box_around(run.start.state.world_positions(run.start.model)); }

// If steps are longer than frames, each step is a frame. The lower rate lets a second of video still be a second of the run.
VideoFormat video_format_of(const PreparedRun& run) {
  const double rate = run.scene.output.frame_rate;
  return {run.scene.output.size.x, run.scene.output.size.y, run.plan.tolerance ? rate : std::min(rate, 1 / run.plan.time_step)};
}

std::unique_ptr<gl::Context> context_for_drawing() {
  std::string reason;
  if (gl::list_adapters(&reason).empty())
    throw Error(ErrorKind::device, "--frames png or --video", "drawing needs OpenGL 4.5: " + reason,
                "install libegl1 and libgl1-mesa-dri, or write obj, ply or vtk frames");
  return std::make_unique<gl::Context>(0);
}

}  // namespace

/// Draws on the GPU device's context. For a CPU device it makes its own context.
class FrameSink::Painter {
 public:
  explicit Painter(PreparedRun& run)
      : run_(run),
        own_context_(gpu::context_of(*run.device) == nullptr ? context_for_drawing() : nullptr),
        renderer_(run.start.model, render::options_for(box_of(run), run.scene.output)) {}

  render::Image paint() {
    const render::DrawnBuffer positions = buffers_.positions(*run_.device, *run_.simulation);
    renderer_.draw(positions.id, positions.first_vertex);
    if (run_.scene.output.marks == Marks::contacts) renderer_.draw_lines(contacts());
    return renderer_.read();
  }

 private:
  render::Lines contacts() {
    render::Lines lines;
    const Model& model = run_.start.model;
    render::add_contacts(lines, *run_.simulation, model, run_.simulation->state().world_positions(model));
    return lines;
  }

  PreparedRun& run_;
  std::unique_ptr<gl::Context> own_context_;
  render::DrawnBuffers buffers_;
  render::FrameRenderer renderer_;
};

FrameSink::FrameSink(PreparedRun& run, FrameTargets targets) : run_(run), targets_(std::move(targets)), count_(targets_.first) {
  if (targets_.format == FrameFormat::png || !targets_.video.empty()) painter_ = std::make_unique<Painter>(run);
  if (!targets_.video.empty()) video_ = std::make_unique<VideoFile>(targets_.video, video_format_of(run));
}

FrameSink::~FrameSink() = default;

void FrameSink::write(const State& state) {
  if (targets_.format == FrameFormat::none && !video_) return;
  if (video_) return write_to_video();
  const int index = count_++;
  const std::filesystem::path path = frame_path(targets_.folder, index, targets_.format);
  if (targets_.format == FrameFormat::png) return write_png(path, painter_->paint());
  const Model& model = run_.start.model;
  const auto positions = state.world_positions(model);
  if (targets_.format == FrameFormat::obj) return write_obj(path, model, positions);
  const auto velocities = state.world_velocities(model);
  if (targets_.format == FrameFormat::ply) return write_ply(path, model, positions, velocities);
  write_vtk(path, model, positions, velocities);
}

void FrameSink::write_to_video() {
  if (lost_video_) return;
  const render::Image picture = painter_->paint();
  try {
    video_->write(picture);
    ++count_;
  } catch (const Error& error) {
    lost_video_ = error;
    run_.warnings.push_back(fmt::format("the video ends here, after {}, and the run goes on: {}",
                                        counted(static_cast<std::size_t>(count_), "frame", "frames"), error.what()));
    fmt::print(stderr, "pliant: warning: {}\n", run_.warnings.back());
  }
}

void FrameSink::close() {
  if (lost_video_) throw *lost_video_;
  if (video_) video_->close();
}

}  // namespace pliant
