#include "run/frame_sink.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "core/counted.hpp"
#include "output/png.hpp"
#include "run/painter.hpp"

namespace pliant {
namespace {

// If steps are longer than frames, each step is a frame. The lower rate lets a second of video still be a second of the run.
VideoFormat video_format_of(const PreparedRun& run) {
  const double rate = run.scene.output.frame_rate;
  return {run.scene.output.size.x, run.scene.output.size.y, run.plan.tolerance ? rate : std::min(rate, 1 / run.plan.time_step)};
}

}  // namespace

FrameSink::FrameSink(PreparedRun& run, FrameTargets targets) : run_(run), targets_(std::move(targets)), count_(targets_.first) {
  if (targets_.format == FrameFormat::png || !targets_.video.empty())
    painter_ = std::make_unique<Painter>(run, run.scene.output, "--frames png or --video");
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
