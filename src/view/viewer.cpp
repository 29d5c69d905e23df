#include "view/viewer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.hpp"
#include "device/gpu/gpu_device.hpp"
#include "output/png.hpp"
#include "view/orbit.hpp"

namespace pliant::view {
namespace {

constexpr double a_picture = 1.0 / 60, a_while = 60;  // to wait for events where nothing is shown, or nothing moves [s]

/// From any origin [s].
double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

nlohmann::ordered_json described(const CameraDescription& camera) {
  const auto place = [](const glm::dvec3& p) { return nlohmann::ordered_json{p.x, p.y, p.z}; };
  return {{"eye", place(camera.eye)}, {"target", place(camera.target)}, {"field_of_view", camera.field_of_view}};
}

glm::uvec2 at_least_a_pixel(const glm::uvec2& size) { return glm::max(size, glm::uvec2(1)); }

std::filesystem::path free_picture_name(const std::string& stem) {
  for (int number = 0;; ++number) {
    std::filesystem::path name = fmt::format("{}_{:04}.png", stem, number);
    if (!std::filesystem::exists(name)) return name;
  }
}

}  // namespace

std::string help() {
  return fmt::format(
      "space       pause, or go on\n"
      ".           one step, and pause\n"
      ",           one step back, and pause; the latest {} MB of states are kept for it\n"
      "R           back to the start\n"
      "F           frame the scene\n"
      "W           wireframe, or surfaces\n"
      "F1          this help\n"
      "F12         save the picture as PNG in the current folder\n"
      "escape      quit\n"
      "drag        left: turn the camera; right: shift it\n"
      "wheel       nearer, farther\n"
      "drop        a scene or an OBJ file, to open it\n",
      Session::history_bytes >> 20);
}

Viewer::Viewer(gl::Window& window, Device& device, SceneDescription scene, const ViewerOptions& options)
    : window_(window), device_(device), playback_(options.pace) {
  if (options.starts_paused) playback_.pause();
  open(std::move(scene));
  if (options.report.empty()) return;
  report_.open(options.report);
  if (!report_)
    throw Error(ErrorKind::command_line, "--report", options.report.string() + " can't be written", "name another file");
}

Viewer::~Viewer() = default;

void Viewer::run() {
  report();
  while (!window_.is_closed()) {
    const std::vector<gl::WindowEvent> events = next_events();
    if (events.empty() && playback_.is_paused()) continue;
    for (const gl::WindowEvent& event : events) std::visit([this](const auto& e) { handle(e); }, event);
    play();
    draw();
    report();
  }
}

// Whatever fails here, the scene before stays.
void Viewer::open(SceneDescription scene) {
  auto session = std::make_unique<Session>(device_, std::move(scene));
  for (const std::string& warning : session->warnings()) fmt::print(stderr, "pliant: warning: {}\n", warning);
  render::RenderOptions options =
      render::options_for(render::box_around(session->start().world_positions(session->model())), session->scene().output);
  options.size = at_least_a_pixel(window_.framebuffer_size());
  if (!session->scene().output.camera)
    options.camera = render::frame_scene(options.scene, static_cast<double>(options.size.x) / options.size.y);
  auto renderer = std::make_unique<render::FrameRenderer>(session->model(), options);
  renderer->set_fill(fill_);
  gl::Buffer positions;
  if (gpu::context_of(device_) == nullptr)
    positions = gl::Buffer(session->model().rest_positions.size() * sizeof(glm::vec4), "drawn positions");
  copied_positions_ = std::move(positions);
  renderer_ = std::move(renderer);
  session_ = std::move(session);
  camera_ = options.camera;
  is_drawn_ = false;
  draw();  // the first picture takes a while, since shaders are compiled; no time is to go by
  playback_.restart();
}

// In a pause there is nothing to draw but what events ask for.
std::vector<gl::WindowEvent> Viewer::next_events() {
  if (playback_.is_paused()) return window_.wait_for_events(a_while);
  return window_.framebuffer_size().x == 0 ? window_.wait_for_events(a_picture) : window_.poll_events();
}

void Viewer::handle(const gl::KeyPressed& event) {
  message_.clear();
  switch (event.key) {
    case gl::Key::space:
      return playback_.toggle_pause();
    case gl::Key::period:
      return step_once();
    case gl::Key::comma:
      return step_back();
    case gl::Key::r:
      return restart();
    case gl::Key::f:
      return frame_scene();
    case gl::Key::w:
      return toggle_wireframe();
    case gl::Key::f1:
      fmt::print("{}", help());
      std::fflush(stdout);
      return;
    case gl::Key::f12:
      return try_to([this] { save_picture(); });
    case gl::Key::escape:
      return window_.close();
  }
}

void Viewer::handle(const gl::MouseDragged& event) {
  const glm::dvec2 size(at_least_a_pixel(window_.framebuffer_size()));
  camera_ = (event.button == gl::MouseButton::left ? orbit : pan)(camera_, event.from, event.to, size);
}

void Viewer::handle(const gl::MouseScrolled& event) { camera_ = zoom(camera_, event.notches); }

void Viewer::handle(const gl::FilesDropped& event) {
  message_.clear();
  try_to([&] { open(describe(event.files.front())); });
}

void Viewer::try_to(const std::function<void()>& wish) {
  try {
    wish();
  } catch (const Error& error) {
    message_ = error.what();
    fmt::print(stderr, "pliant: {}\n", message_);
  }
}

void Viewer::play() {
  playback_.begin(now(), session_->time());
  const std::uint64_t before = session_->step();
  double clock = now();
  while (session_->is_before(playback_.goal()) && playback_.has_time(clock)) {
    session_->advance_toward(playback_.goal(), batch_.steps());
    const double since = std::exchange(clock, now());
    batch_.took(clock - since);
  }
  playback_.end(session_->time(), !session_->is_before(playback_.goal()));
  if (session_->step() != before) session_->record();
  if (session_->non_finite() && !playback_.is_paused()) tell_of_non_finite();
}

void Viewer::tell_of_non_finite() {
  playback_.pause();
  const NonFinite& broken = *session_->non_finite();
  message_ = fmt::format("body {} became non-finite in step {}", session_->model().bodies[broken.body].name, session_->step());
  fmt::print(stderr, "pliant: {}; a shorter time_step may help\n", message_);
}

void Viewer::step_once() {
  playback_.pause();
  session_->step_once();
  session_->record();
}

void Viewer::step_back() {
  playback_.pause();
  if (!session_->step_back()) message_ = "no earlier state is kept";
}

void Viewer::restart() {
  session_->restart();
  playback_.restart();
}

// As it is, not as it was at the start: the state visits the CPU for that.
void Viewer::frame_scene() {
  const auto positions = session_->simulation().state().world_positions(session_->model());
  camera_ = frame(camera_, render::box_around(positions), at_least_a_pixel(window_.framebuffer_size()));
}

void Viewer::toggle_wireframe() {
  fill_ = fill_ == render::Fill::surface ? render::Fill::wireframe : render::Fill::surface;
  renderer_->set_fill(fill_);
}

void Viewer::save_picture() {
  if (!is_drawn_) return;
  const std::filesystem::path name = free_picture_name(session_->scene().file.stem().string());
  write_png(name, renderer_->read());
  message_ = "saved " + name.string();
  fmt::print("{}\n", message_);
  std::fflush(stdout);
}

void Viewer::draw() {
  const glm::uvec2 size = window_.framebuffer_size();
  if (size.x == 0) return;
  renderer_->resize(size);
  renderer_->set_camera(camera_);
  Simulation& simulation = session_->simulation();
  if (gpu::context_of(device_) != nullptr) {
    renderer_->draw(gpu::gl_buffer_of(device_, simulation.position_buffer()), simulation.first_position());
  } else {
    const std::vector<glm::vec4> positions = simulation.world_positions();
    copied_positions_.write(0, std::as_bytes(std::span(positions)));
    renderer_->draw(copied_positions_.id(), 0);
  }
  renderer_->copy_to_window();
  window_.swap();
  is_drawn_ = true;
}

std::string Viewer::title() const {
  std::string state;
  if (!message_.empty())
    state = message_;
  else if (playback_.is_paused())
    state = fmt::format("paused at {:.4g} s", session_->time());
  else if (const double factor = playback_.slow_factor().value_or(playback_.speed()); factor != 1)
    state = fmt::format("{:.2g} x real time", factor);
  return fmt::format("{} - pliant{}", session_->title(), state.empty() ? "" : fmt::format(" ({})", state));
}

void Viewer::report() {
  if (const std::string wanted = title(); wanted != shown_title_) window_.set_title(shown_title_ = wanted);
  ++picture_;
  if (!report_.is_open()) return;
  const glm::uvec2 size = window_.framebuffer_size();
  const nlohmann::ordered_json line = {{"frame", picture_},
                                       {"scene", session_->scene().file.string()},
                                       {"step", session_->step()},
                                       {"time", session_->time()},
                                       {"paused", playback_.is_paused()},
                                       {"wireframe", fill_ == render::Fill::wireframe},
                                       {"size", {size.x, size.y}},
                                       {"camera", described(camera_)},
                                       {"title", shown_title_}};
  report_ << line.dump() << std::endl;
}

}  // namespace pliant::view
