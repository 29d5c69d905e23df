#include "bench/draw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "bench/step_cases.hpp"
#include "bench/timing.hpp"
#include "device/gpu/gpu_device.hpp"
#include "gl/objects.hpp"
#include "render/frame_renderer.hpp"

namespace pliant::bench {
namespace {

constexpr int marked_frames = 21, quick_marked_frames = 3;

struct Look {
  glm::uvec2 size;  // [pixels]
  render::Detail detail;
};

render::RenderOptions options_for(std::span<const glm::dvec3> world, const Look& look) {
  OutputDescription output;
  output.size = look.size;
  render::RenderOptions options = render::options_for(render::box_around(world), output);
  options.detail = look.detail;
  options.pictures_per_clear = render::most_pictures_per_clear;
  return options;
}

// A scene at its start, ready to be drawn.
class Drawing {
 public:
  Drawing(const ModelAndState& start, const Look& look) : Drawing(start, look, start.state.world_positions(start.model)) {}

  void draw(const render::PassObserver& after_pass = {}) { renderer_.draw(positions_.id(), 0, after_pass); }

 private:
  Drawing(const ModelAndState& start, const Look& look, const std::vector<glm::dvec3>& world)
      : positions_(world.size() * sizeof(glm::vec4), "drawn positions"), renderer_(start.model, options_for(world, look)) {
    std::vector<glm::vec4> rounded;
    for (const glm::dvec3& place : world) rounded.emplace_back(glm::vec3(place), 1.0f);
    positions_.write(0, std::as_bytes(std::span(rounded)));
  }

  gl::Buffer positions_;
  render::FrameRenderer renderer_;
};

using PassTimes = std::vector<std::pair<std::string, double>>;

// A frame's passes [ms], by a mark after each.
PassTimes time_passes(Device& device, Drawing& drawing) {
  PassTimes passes;
  device.mark_time();
  drawing.draw([&](const char* pass) {
    device.mark_time();
    passes.emplace_back(pass, 0);
  });
  const std::vector<double> marks = device.take_times();
  for (std::size_t k = 0; k < passes.size(); ++k) passes[k].second = 1e3 * (marks[k + 1] - marks[k]);
  return passes;
}

PassTimes median_passes(Device& device, Drawing& drawing, int frames) {
  std::vector<PassTimes> measured;
  for (int frame = 0; frame < frames; ++frame) measured.push_back(time_passes(device, drawing));
  PassTimes medians = measured.front();
  for (std::size_t pass = 0; pass < medians.size(); ++pass) {
    std::vector<double> times;
    for (const PassTimes& frame : measured) times.push_back(frame[pass].second);
    medians[pass].second = median(std::move(times));
  }
  return medians;
}

DrawRow measure(Device& device, const StepCase& what, const DrawOptions& options) {
  const Model& model = what.start.model;
  const bool software = gpu::context_of(device)->adapter().is_software;
  Drawing drawing(what.start, {options.size, software ? render::Detail::reduced : render::Detail::full});
  const Timing frame = seconds_each(device, options.quick ? quick_effort : Effort{}, [&] { drawing.draw(); });
  return {.scene = what.name,
          .vertices = model.vertex_count(),
          .triangles = static_cast<std::uint32_t>(model.triangles.size()),
          .bodies = static_cast<std::uint32_t>(model.bodies.size()),
          .detail = software ? "reduced" : "full",
          .width = options.size.x,
          .height = options.size.y,
          .milliseconds_per_frame = 1e3 * frame.median,
          .fastest_milliseconds_per_frame = 1e3 * frame.fastest,
          .milliseconds = median_passes(device, drawing, options.quick ? quick_marked_frames : marked_frames)};
}

}  // namespace

DrawResult bench_draw(const DrawOptions& options, const Progress& progress) {
  StepCases all = load_step_cases(options.scenes, options.quick);
  DrawResult result{.rows = {}, .notes = std::move(all.notes), .interrupted = false};
  const auto device = open({.device = "gpu", .gpu_index = options.gpu_index});
  for (const StepCase& what : all.cases) {
    const double part = static_cast<double>(result.rows.size()) / static_cast<double>(all.cases.size());
    result.interrupted = !progress(part, what.name);
    if (result.interrupted) return result;
    result.rows.push_back(measure(*device, what, options));
  }
  progress(1, "");
  return result;
}

}  // namespace pliant::bench
