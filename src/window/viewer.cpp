#include "window/viewer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "core/error.hpp"
#include "core/json.hpp"
#include "simulation/breakdown.hpp"
#include "view/orbit.hpp"
#include "view/present_scene.hpp"
#include "view/thrown_ball.hpp"
#include "window/saved_files.hpp"

namespace pliant::view {
namespace {

constexpr double a_picture = 1.0 / 60, a_while = 60;  // time to wait for events if no new picture is due, or in a pause [s]
constexpr int pictures_after_an_event = 3;            // ImGui takes one picture each for a press, a release and their effect

/// Returns the time from any origin [s].
double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

Json described(const CameraDescription& camera) {
  const auto place = [](const glm::dvec3& p) { return Json::array({p.x, p.y, p.z}); };
  return {{"eye", place(camera.eye)}, {"target", place(camera.target)}, {"field_of_view", camera.field_of_view}};
}

glm::uvec2 at_least_a_pixel(const glm::uvec2& size) { return glm::max(size, glm::uvec2(1)); }

}  // namespace

struct Viewer::Command {
  std::string_view key;  // as KeyPressed names it
  std::string_view help;
  void (Viewer::*execute)();
  bool repeats = false;        // while the key is held, once a picture
  bool keeps_message = false;  // so that it can be read in the panel
};

std::span<const Viewer::Command> Viewer::commands() {
  static constexpr Command list[] = {
      {"space", "pause, or go on", &Viewer::pause_or_go_on},
      {".", "one step, and pause", &Viewer::step_once, true},
      {",", "one step back, and pause", &Viewer::step_back, true},
      {"R", "back to the start", &Viewer::restart},
      {"B", "throw a ball from the camera to where the mouse is", &Viewer::throw_ball},
      {"H", "a hand at the mouse, or none; the wheel takes it nearer and farther", &Viewer::toggle_hand},
      {"S", "shake the containers", &Viewer::shake},
      {"X", "remove the body under the mouse", &Viewer::remove_body},
      {"F", "frame the scene", &Viewer::frame_scene},
      {"D", "go on on the other device, CPU or GPU", &Viewer::switch_device},
      {"W", "wireframe, or surfaces", &Viewer::toggle_wireframe},
      {"tab", "the panel, or none", &Viewer::toggle_panel, false, true},
      {"F1", "this help, or none", &Viewer::toggle_help, false, true},
      {"F11", "save the scene as it is, in the current folder", &Viewer::save_scene},
      {"F12", "save the picture as PNG in the current folder", &Viewer::save_picture},
      {"escape", "quit", &Viewer::close},
  };
  return list;
}

std::string Viewer::help() {
  std::string text;
  for (const Command& command : commands()) text += fmt::format("{:<12}{}\n", command.key, command.help);
  return text +
         "drag        left: turn the camera; right: shift it\n"
         "Ctrl+drag   pull a body by the vertex under the mouse\n"
         "wheel       nearer, farther\n"
         "drop        a scene or an OBJ file, to open it\n";
}

Viewer::Viewer(Window& window, std::unique_ptr<Device> device, LoadedScene scene, const ViewerOptions& options)
    : window_(window), device_(std::move(device)), make_device_(options.make_device), playback_(options.pace), observer_(now) {
  if (options.starts_paused) playback_.pause();
  open(std::move(scene));
  if (options.report.empty()) return;
  report_.open(options.report, std::ios::app);  // behind the start page's lines
  if (!report_)
    throw Error(ErrorKind::command_line, "--report", options.report.string() + " can't be written", "name another file");
}

void Viewer::run() {
  draw();
  tell();
  while (!window_.is_closed()) {
    await_events();
    const bool had_events = !events_.empty();
    if (!had_events && playback_.is_paused() && owed_pictures_ == 0) continue;
    handle_events();
    if (window_.is_closed()) return;
    owed_pictures_ = had_events && is_overlaid() ? pictures_after_an_event : std::max(owed_pictures_ - 1, 0);
    play();
    draw();
    fulfil();
    tell();
  }
}

// Everything that can fail comes first, so that the scene before stays if something does. The first picture is part of that. It
// takes a while, because shaders are compiled.
void Viewer::open(LoadedScene scene) {
  std::vector<std::filesystem::path> scenes = scenes_beside(scene.description.file);
  auto session = std::make_unique<Session>(*device_, std::move(scene));
  const glm::uvec2 size = at_least_a_pixel(window_.framebuffer_size());
  auto view = std::make_unique<SceneView>(*session, size, render::live_detail(window_.context().adapter().is_software));
  Shows shows = shows_;
  shows.colors = session->scene().output.coloring == Coloring::deformation ? Colors::deformation : Colors::body;
  view->draw({.step = 0, .camera = view->first_camera(), .size = size, .shows = shows});
  session->time_passes(times_passes_);
  view_ = std::move(view);
  session_ = std::move(session);
  scenes_ = std::move(scenes);
  shows_ = shows;
  camera_ = view_->first_camera();
  observer_.forget();
  shown_.reset();
  is_breakdown_told_ = false;
  playback_.restart();
}

// Waits if there is nothing to draw. In a pause only events ask for pictures.
void Viewer::await_events() {
  const bool is_paused = playback_.is_paused(), waits = events_.empty() && (is_paused || is_up_to_date_);
  const double longest = is_paused && owed_pictures_ == 0 ? a_while : a_picture;
  std::ranges::move(waits ? window_.wait_for_events(longest) : window_.poll_events(), std::back_inserter(events_));
}

// ImGui looks at buttons and keys once a picture, so the panel gets at most one press or release in it. Later events wait for
// the next.
void Viewer::handle_events() {
  bool is_heard = false;
  while (!events_.empty() && !window_.is_closed() && !is_heard) {
    const WindowEvent event = std::move(events_.front());
    events_.pop_front();
    if (panel_ == nullptr || !panel_->takes(event))
      std::visit([this](const auto& e) { handle(e); }, event);
    else
      is_heard = !std::holds_alternative<MouseMoved>(event) && !std::holds_alternative<MouseScrolled>(event);
  }
}

void Viewer::handle(const KeyPressed& event) {
  const auto command = std::ranges::find(commands(), event.name, &Command::key);
  if (command == commands().end()) return;
  if (event.is_repeat && (!command->repeats || std::exchange(has_repeated_, true))) return;
  if (!command->keeps_message) message_.clear();
  try_to([&] { (this->*command->execute)(); });
}

// Picks a vertex and pulls it from then on in a plane parallel to the picture. Picking reads the positions back to the CPU once.
void Viewer::handle(const MousePressed& event) {
  if (event.button != MouseButton::left || !event.with_control) return;
  const std::vector<glm::vec4> positions = session_->simulation().world_positions();
  const glm::dvec2 size(at_least_a_pixel(window_.framebuffer_size()));
  const std::optional<std::uint32_t> vertex = pick_vertex(session_->model(), positions, ray_through(camera_, event.place, size));
  if (!vertex) return;
  pulled_from_ = glm::dvec3(glm::vec3(positions[*vertex]));
  session_->pull(Pull{.vertex = *vertex, .target = pulled_from_});
}

void Viewer::handle(const MouseReleased& event) {
  if (event.button != MouseButton::left) return;
  session_->pull(std::nullopt);
}

void Viewer::handle(const MouseMoved& event) {
  mouse_ = event.to;
  if (!event.held) return;
  const glm::dvec2 size(at_least_a_pixel(window_.framebuffer_size()));
  if (std::optional<Pull> pull = session_->pulled()) {
    pull->target = meet_plane(ray_through(camera_, event.to, size), pulled_from_, render::axes_of(camera_).back);
    return session_->pull(pull);
  }
  camera_ = (*event.held == MouseButton::left ? orbit : pan)(camera_, event.from, event.to, size);
}

void Viewer::handle(const MouseScrolled& event) {
  if (session_->hand())
    hand_distance_ *= std::pow(1.05, event.notches);
  else
    camera_ = zoom(camera_, event.notches);
}

void Viewer::handle(const FilesDropped& event) {
  message_.clear();
  try_to([&] { open_file(event.files.front()); });
}

void Viewer::open_file(const std::filesystem::path& file) {
  LoadedScene scene = load(file);
  for (const std::string& warning : scene.warnings) fmt::print(stderr, "pliant: warning: {}\n", warning);
  open(std::move(scene));
}

void Viewer::try_to(const std::function<void()>& wish) {
  try {
    wish();
  } catch (const std::exception& error) {
    message_ = error.what();
    fmt::print(stderr, "pliant: {}\n", message_);
  }
}

// Starts the clock when the GPU has drawn the picture before, because waiting for that is not stepping.
void Viewer::play() {
  constexpr double record_interval = 0.1;  // [s]
  device_->finish();
  if (session_->hand() && !playback_.is_paused()) lead_hand();
  playback_.begin(now(), session_->time());
  const std::uint64_t before = session_->step();
  double clock = now();
  while (session_->is_due(playback_.goal()) && playback_.has_time(clock)) {
    session_->advance_toward(playback_.goal(), batch_.steps());
    const double since = std::exchange(clock, now());
    batch_.took(clock - since);
  }
  playback_.end(clock, session_->time(), !session_->is_due(playback_.goal()));
  if (session_->step() != before && clock - recorded_at_ > record_interval && session_->simulation().can_save_soon()) {
    session_->record();
    recorded_at_ = clock;
  }
  if (!playback_.is_paused()) tell_if_broken();
}

void Viewer::tell_if_broken() {
  if (!session_->breakdown()) return;
  playback_.pause();
  message_ = describe_breakdown(*session_->breakdown(), session_->plan(), session_->model());
  if (std::exchange(is_breakdown_told_, true)) return;
  fmt::print(stderr, "pliant: {}\n", message_);
}

void Viewer::pause_or_go_on() { playback_.toggle_pause(); }

void Viewer::step_once() {
  playback_.pause();
  session_->step_once();
  session_->record();
  tell_if_broken();
}

void Viewer::step_back() {
  playback_.pause();
  if (!session_->step_back()) message_ = "no earlier state is kept";
  is_breakdown_told_ = session_->breakdown().has_value();
}

void Viewer::restart() {
  session_->restart();
  is_breakdown_told_ = false;
  observer_.forget();
  playback_.restart();
}

Ray Viewer::ray_at_mouse() const {
  return ray_through(camera_, mouse_, glm::dvec2(at_least_a_pixel(window_.framebuffer_size())));
}

void Viewer::throw_ball() {
  session_->add(ball_to_throw(session_->model(), session_->radius(), ray_at_mouse(), session_->scene().simulation.gravity));
  observer_.count_anew();
}

void Viewer::remove_body() {
  const std::vector<glm::vec4> positions = session_->simulation().world_positions();
  const std::optional<std::uint32_t> vertex = pick_vertex(session_->model(), positions, ray_at_mouse());
  if (!vertex) return void(message_ = "there is no body under the mouse");
  session_->remove(session_->model().body_index(*vertex));
  observer_.count_anew();
}

void Viewer::shake() {
  if (std::ranges::none_of(session_->model().bodies, &ModelBody::is_container)) message_ = "there is no container to shake";
  session_->shake();
  observer_.count_anew();
}

void Viewer::toggle_hand() {
  observer_.count_anew();
  if (session_->hand()) return session_->take_hand();
  const Ray ray = ray_at_mouse();
  const glm::dvec3 direction = glm::normalize(ray.direction);
  const std::vector<glm::vec4> positions = session_->simulation().world_positions();
  const std::optional<std::uint32_t> under_it = pick_vertex(session_->model(), positions, ray);
  const double radius = 0.08 * session_->radius();
  const glm::dvec3 aim = under_it ? glm::dvec3(glm::vec3(positions[*under_it])) : camera_.target;
  hand_distance_ = std::max(glm::dot(aim - ray.origin, direction) - (under_it ? 3 * radius : 0), 2 * radius);
  session_->put_hand(ray.origin + hand_distance_ * direction, radius);
}

// The hand is behind the mouse by some pictures, so that it does not hit what it touches.
void Viewer::lead_hand() {
  constexpr double arrives_after = 0.1;  // [s] of the simulation
  const Ray ray = ray_at_mouse();
  session_->send_hand(ray.origin + hand_distance_ * glm::normalize(ray.direction), arrives_after);
}

// The picture does not change, because the positions on the other device are the same.
void Viewer::switch_device() {
  if (device_->precision() != 32) throw Error(ErrorKind::command_line, "", "fp64 forces run on the CPU alone", "");
  std::unique_ptr<Device> other = make_device_(is_on_gpu() ? DeviceKind::cpu : DeviceKind::gpu);
  session_->move_to(*other);
  device_ = std::move(other);
  observer_.count_anew();
  playback_.restart();
  message_ = fmt::format("on the {}: {}", is_on_gpu() ? "GPU" : "CPU", device_->info().name);
}

// Frames the bodies where they are, not where they started. Reads the state back to the CPU.
void Viewer::frame_scene() {
  const auto positions = session_->simulation().state().world_positions(session_->model());
  camera_ = frame(camera_, render::box_around(positions), at_least_a_pixel(window_.framebuffer_size()));
}

void Viewer::toggle_wireframe() { shows_.wireframe = !shows_.wireframe; }

void Viewer::toggle_panel() {
  toggle(shows_panel_);
  observer_.count_anew();
}

void Viewer::toggle_help() { toggle(shows_help_); }

void Viewer::toggle(bool& is_shown) {
  if (panel_ == nullptr) panel_ = std::make_unique<Panel>(window_.scale());
  is_shown = !is_shown;
  if (!is_overlaid()) panel_->hide();
  shown_.reset();
}

void Viewer::save_picture() {
  const Look wanted = look();
  if (wanted.size.x == 0)
    throw Error(ErrorKind::command_line, "", "there is no picture to save while the window is minimised", "");
  view_->draw(wanted);
  say_saved(view::save_picture(session_->scene().file.stem().string(), view_->picture()));
}

// Opens the file to see whether it can be opened. Bodies without their deformation may intersect.
void Viewer::save_scene() {
  SceneDescription scene = present_scene(*session_);
  scene.output.camera = camera_;
  scene.output.ground_height = view_->ground_height();
  scene.output.marks = shows_.contacts ? Marks::contacts : Marks::none;
  if (shows_.colors != Colors::speed)
    scene.output.coloring = shows_.colors == Colors::deformation ? Coloring::deformation : Coloring::body;
  const std::filesystem::path name = view::save_scene(scene);
  say_saved(name);
  scenes_ = scenes_beside(scene.file);
  try {
    const Session opened(*device_, load(name));
  } catch (const Error& error) {
    throw Error(error.kind(), message_, fmt::format("it can't be opened as it is: {}", error.what()), "");
  }
}

void Viewer::say_saved(const std::filesystem::path& name) {
  message_ = "saved " + name.string();
  fmt::print("{}\n", message_);
  std::fflush(stdout);
}

void Viewer::close() { window_.close(); }

Look Viewer::look() const { return {session_->step(), camera_, window_.framebuffer_size(), shows_, session_->bodies_version()}; }

// Draws nothing if the window already shows this look, unless the panel or the help lies over it.
void Viewer::draw() {
  has_repeated_ = false;
  const Look wanted = look();
  is_up_to_date_ = wanted.size.x == 0 || shown_ == wanted;
  if (wanted.size.x == 0 || (is_up_to_date_ && !is_overlaid())) return;
  view_->draw(wanted);
  present(wanted.size);
  shown_ = wanted;
}

void Viewer::present(const glm::uvec2& size) {
  const double at = now(), seconds = at - std::exchange(presented_at_, at);
  picture_seconds_ += 0.1 * (std::min(seconds, 1.0) - picture_seconds_);
  view_->show();
  if (shows_panel_)
    draw_panel(size, seconds);
  else if (shows_help_)
    panel_->draw_help(size, seconds, help());
  window_.swap();
}

void Viewer::draw_panel(const glm::uvec2& size, double seconds) {
  observer_.look(*session_);
  wanted_ = wishes();
  panel_->draw(size, seconds, facts(), *wanted_, shows_help_ ? help() : "");
}

Facts Viewer::facts() const {
  const StepReport& report = session_->report();
  Facts facts{.title = session_->scene().title,
              .device = device_->info().name,
              .message = message_,
              .scenes = scenes_,
              .scene = session_->scene().file,
              .bodies = {},
              .step = session_->step(),
              .vertices = session_->model().vertex_count(),
              .time = session_->time(),
              .time_step = session_->plan().time_step,
              .tolerance = session_->plan().tolerance,
              .pictures_per_second = picture_seconds_ > 0 ? 1 / picture_seconds_ : 0,
              .factor = playback_.factor(),
              .deepest_level = session_->deepest_level(),
              .report = report,
              .observation = &observer_.observation()};
  for (const ModelBody& body : session_->model().bodies) facts.bodies.push_back(body.name);
  return facts;
}

Wishes Viewer::wishes() const {
  return {.is_paused = playback_.is_paused(),
          .times_passes = times_passes_,
          .is_on_gpu = is_on_gpu(),
          .speed = playback_.speed(),
          .settings = session_->settings(),
          .shows = shows_,
          .scene = {}};
}

void Viewer::fulfil() {
  if (!wanted_) return;
  const Wishes before = wishes(), wanted = *std::exchange(wanted_, std::nullopt);
  if (wanted == before) return;
  message_.clear();
  shows_ = wanted.shows;
  playback_.set_speed(wanted.speed);
  if (wanted.times_passes != before.times_passes) session_->time_passes(times_passes_ = wanted.times_passes);
  if (wanted.is_paused != before.is_paused) pause_or_go_on();
  if (wanted.is_on_gpu != before.is_on_gpu) try_to([this] { switch_device(); });
  if (wanted.settings != before.settings) try_to([&] { change(wanted.settings); });
  if (wanted.saves_scene) try_to([this] { save_scene(); });
  if (wanted.restarts) try_to([this] { restart(); });
  if (wanted.steps) step_once();
  if (wanted.steps_back) step_back();
  if (wanted.scene) try_to([&] { open_file(*wanted.scene); });
}

void Viewer::change(const Settings& wanted) {
  const bool is_broken = session_->breakdown().has_value();
  session_->change(wanted);
  if (!is_broken) return observer_.count_anew();
  is_breakdown_told_ = false;  // it is at its start again
  observer_.forget();
}

std::string Viewer::title() const {
  std::string state;
  if (!message_.empty())
    state = message_;
  else if (playback_.is_paused())
    state = fmt::format("paused at {:.4g} s", session_->time());
  else if (playback_.factor() != 1)
    state = fmt::format("{:.2g} x real time", playback_.factor());
  return fmt::format("{} - pliant{}", session_->scene().title, state.empty() ? "" : fmt::format(" ({})", state));
}

void Viewer::tell() {
  if (const std::string wanted = title(); wanted != shown_title_) window_.set_title(shown_title_ = wanted);
  ++picture_;
  if (!report_.is_open()) return;
  const glm::uvec2 size = window_.framebuffer_size();
  const Json line = {{"frame", picture_},
                     {"scene", session_->scene().file.string()},
                     {"step", session_->step()},
                     {"time", session_->time()},
                     {"paused", playback_.is_paused()},
                     {"speed", playback_.speed()},
                     {"device", name_of(device_->info().kind)},
                     {"pulls", session_->pulled().has_value()},
                     {"bodies", session_->model().bodies.size()},
                     {"hand", session_->hand().has_value()},
                     {"wireframe", shows_.wireframe},
                     {"panel", shows_panel_},
                     {"help", shows_help_},
                     {"windows", panel_ == nullptr ? 0 : panel_->window_count()},
                     {"size", Json::array({size.x, size.y})},
                     {"camera", described(camera_)},
                     {"title", shown_title_},
                     {"message", message_}};
  report_ << line.text() << std::endl;
}

}  // namespace pliant::view
