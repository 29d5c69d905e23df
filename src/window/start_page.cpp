#include "window/start_page.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>

#include "core/error.hpp"
#include "view/scene_view.hpp"
#include "view/session.hpp"
#include "window/style.hpp"

namespace pliant::view {
namespace {

constexpr glm::uvec2 picture_size{480, 300};                       // [pixels]
constexpr float page_text_height = 15, gap = 18, narrowest = 300;  // [pixels of a usual display]
constexpr double measuring_time = 0.25;                            // [s] of steps of each demo

double clock_time() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

constexpr double time_of_a_picture = 1.0 / 60;  // [s]

// Returns how long a picture's steps take in real time [s]. Bodies that lie in heaps later take longer.
double simulating_time(Session& session) {
  const double begin = clock_time();
  session.step_once();  // builds the kernels
  const double before = session.time(), from = clock_time();
  while (!session.breakdown() && (clock_time() - begin < measuring_time || session.time() == before)) session.step_once();
  return time_of_a_picture * (clock_time() - from) / (session.time() - before);
}

// Returns how long a picture takes to be drawn [s]. Only one with another look than the last is drawn anew.
double drawing_time(SceneView& view, Look look) {
  const double begin = clock_time();
  int pictures = 0;
  do {
    look.camera.field_of_view = view.first_camera().field_of_view + 1e-6 * ++pictures;
    view.draw(look);
    static_cast<void>(view.picture());  // waits for it
  } while (clock_time() - begin < measuring_time);
  return (clock_time() - begin) / pictures;
}

std::string in_milliseconds(double seconds) { return fmt::format("{:.{}f} ms", 1e3 * seconds, seconds < 0.01 ? 1 : 0); }

std::string told(double simulating, double drawing) {
  return fmt::format("{}{} to simulate and {} to draw of a picture's 16.7, and more when bodies meet",
                     simulating + drawing > time_of_a_picture ? "slow motion here: " : "", in_milliseconds(simulating),
                     in_milliseconds(drawing));
}

}  // namespace

struct StartPage::Entry {
  Demo demo;
  std::unique_ptr<Session> session;
  std::unique_ptr<SceneView> view;  // empty: not drawn yet, or it can't be
  std::string speed;                // in words, or why it can't be drawn
};

StartPage::StartPage(Window& window, Device& device, std::vector<Demo> demos) : window_(window), device_(device) {
  for (Demo& demo : demos) entries_.push_back(std::make_unique<Entry>(Entry{std::move(demo), {}, {}, ""}));
  begin_style(window.scale(), page_text_height);
}

StartPage::~StartPage() { end_style(); }

std::optional<std::filesystem::path> StartPage::choose(const std::function<void(std::size_t)>& tell) {
  window_.set_title("pliant");
  while (!window_.is_closed() && !chosen_) {
    const bool is_ready = prepared_ == entries_.size();
    for (const WindowEvent& event : is_ready ? window_.wait_for_events(1.0 / 30) : window_.poll_events()) {
      handle(event);
      if (std::holds_alternative<MousePressed>(event) || std::holds_alternative<MouseReleased>(event))
        draw();  // ImGui has to see each
    }
    draw();
    tell(prepared_);
    if (!is_ready) prepare_next();
  }
  return window_.is_closed() ? std::nullopt : chosen_;
}

void StartPage::handle(const WindowEvent& event) {
  ImGuiIO& io = ImGui::GetIO();
  const auto at = [&](const glm::dvec2& place) { io.MousePos = {static_cast<float>(place.x), static_cast<float>(place.y)}; };
  if (const auto* moved = std::get_if<MouseMoved>(&event)) at(moved->to);
  if (const auto* pressed = std::get_if<MousePressed>(&event)) {
    at(pressed->place);
    io.MouseDown[pressed->button == MouseButton::left ? 0 : 1] = true;
  }
  if (const auto* released = std::get_if<MouseReleased>(&event))
    io.MouseDown[released->button == MouseButton::left ? 0 : 1] = false;
  if (const auto* scrolled = std::get_if<MouseScrolled>(&event)) io.MouseWheel += static_cast<float>(scrolled->notches);
  if (const auto* dropped = std::get_if<FilesDropped>(&event)) choose_file(dropped->files.front());
  if (const auto* key = std::get_if<KeyPressed>(&event); key != nullptr && key->name == "escape") window_.close();
}

// A file that is no scene leaves the page as it is.
void StartPage::choose_file(const std::filesystem::path& file) {
  try {
    static_cast<void>(Session(device_, load(file), 0));
    chosen_ = file;
  } catch (const std::exception& error) {
    message_ = error.what();
    fmt::print(stderr, "pliant: {}\n", message_);
  }
}

// The session stays where it is after measuring: its start is what is drawn.
void StartPage::prepare_next() {
  Entry& entry = *entries_[prepared_++];
  try {
    entry.session = std::make_unique<Session>(device_, load(entry.demo.scene));
    entry.view =
        std::make_unique<SceneView>(*entry.session, picture_size, render::live_detail(window_.context().adapter().is_software));
    const Look start{.step = 0, .camera = entry.view->first_camera(), .size = picture_size, .shows = {}};
    entry.view->draw(start);
    const double drawing = drawing_time(*entry.view, start);
    entry.view->show();  // so that the window's own framebuffer is bound again
    entry.speed = told(simulating_time(*entry.session), drawing);
  } catch (const Error& error) {
    entry.view.reset();
    entry.speed = error.what();
  }
}

void StartPage::draw() {
  const glm::uvec2 size = window_.framebuffer_size();
  if (size.x == 0) return;
  begin_picture(size, 1.0 / 60);
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize({static_cast<float>(size.x), static_cast<float>(size.y)});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, {0.09f, 0.10f, 0.12f, 1});
  ImGui::Begin("start", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBringToFrontOnFocus);
  const float unit = ImGui::GetFontSize() / page_text_height, between = gap * unit;
  ImGui::SetWindowFontScale(1.5f);
  ImGui::TextUnformatted("pliant");
  ImGui::SetWindowFontScale(1);
  ImGui::SameLine(0, between);
  ImGui::TextDisabled("Click a demo, or drop a scene or an OBJ file here. %s.", device_.info().name.c_str());
  if (!message_.empty()) ImGui::TextWrapped("%s", message_.c_str());
  ImGui::BeginChild("demos", {0, 0}, false, 0);
  const float across = ImGui::GetContentRegionAvail().x;
  const int columns = std::max(1, static_cast<int>((across + between) / (narrowest * unit + between)));
  const float width = (across - static_cast<float>(columns - 1) * between) / static_cast<float>(columns);
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    if (k % static_cast<std::size_t>(columns) != 0) ImGui::SameLine(0, between);
    ImGui::PushID(static_cast<int>(k));
    ImGui::BeginGroup();
    draw_entry(*entries_[k], width);
    ImGui::EndGroup();
    ImGui::PopID();
  }
  ImGui::EndChild();
  ImGui::End();
  ImGui::PopStyleColor();
  end_picture();
  window_.swap();
}

void StartPage::draw_entry(Entry& entry, float width) {
  const ImVec2 size(width, width * static_cast<float>(picture_size.y) / static_cast<float>(picture_size.x));
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, 0});
  bool is_chosen = false;
  if (entry.view) {
    auto* const texture = reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(entry.view->picture_texture()));
    is_chosen = ImGui::ImageButton(texture, size, {0, 1}, {1, 0});  // OpenGL's first row is the lowest
  } else {
    is_chosen = ImGui::Button(entry.speed.empty() ? "..." : "no picture", size);
  }
  ImGui::PopStyleVar();
  if (is_chosen && (entry.view || entry.speed.empty())) choose_file(entry.demo.scene);
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
  ImGui::TextUnformatted(entry.demo.title.c_str());
  ImGui::TextDisabled("%s", entry.demo.about.c_str());
  ImGui::TextDisabled("%s", entry.speed.c_str());
  ImGui::PopTextWrapPos();
  ImGui::Dummy({width, ImGui::GetFontSize() / 2});
}

}  // namespace pliant::view
