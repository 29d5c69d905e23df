// Draws the panel with Dear ImGui. It gets window events from takes(), so that only window.cpp knows GLFW.
#include "window/panel.hpp"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include "dynamics/integrator.hpp"
#include "window/style.hpp"

namespace pliant::view {
namespace {

constexpr float margin = 10, width = 330, plot_height = 56, text_height = 13;  // [pixels of a usual display]

/// Converts a length on a usual display to this display [pixels]. Call it only between begin() and end().
float scaled(float pixels) { return pixels * ImGui::GetFontSize() / text_height; }

template <class... T>
void say(fmt::format_string<T...> format, T&&... values) {
  const std::string text = fmt::format(format, std::forward<T>(values)...);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
}

void say_muted(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

/// Of whole numbers, which can't be typed.
constexpr ImGuiSliderFlags by_mouse = ImGuiSliderFlags_NoInput | ImGuiSliderFlags_AlwaysClamp;

/// Ctrl and a click let a number be typed. Keys belong to it until the enter key.
bool slide(const char* label, double& value, double low, double high, const char* format, bool logarithmic = true) {
  return ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &low, &high, format,
                             ImGuiSliderFlags_AlwaysClamp | (logarithmic ? ImGuiSliderFlags_Logarithmic : 0));
}

void choose_scene(const Facts& facts, Wishes& wishes) {
  if (!ImGui::BeginCombo("scene", facts.scene.filename().c_str())) return;
  for (const std::filesystem::path& scene : facts.scenes) {  // the name is no label, because labels end at "##"
    ImGui::PushID(scene.c_str());
    if (ImGui::Selectable("##scene", scene == facts.scene)) wishes.scene = scene;
    ImGui::SameLine(0, 0);
    ImGui::TextUnformatted(scene.filename().c_str());
    ImGui::PopID();
  }
  ImGui::EndCombo();
}

void save_scene(Wishes& wishes) {
  ImGui::SameLine();
  wishes.saves_scene = ImGui::Button("save");
}

void choose_device(Wishes& wishes) {
  int device = wishes.is_on_gpu ? 1 : 0;
  ImGui::RadioButton("CPU", &device, 0);
  ImGui::SameLine();
  ImGui::RadioButton("GPU", &device, 1);
  wishes.is_on_gpu = device == 1;
}

void play(const Facts& facts, Wishes& wishes) {
  if (ImGui::Button(wishes.is_paused ? "play" : "pause", {scaled(60), 0})) wishes.is_paused = !wishes.is_paused;
  ImGui::SameLine();
  wishes.steps_back = ImGui::Button("<");
  ImGui::SameLine();
  wishes.steps = ImGui::Button(">");
  ImGui::SameLine();
  wishes.restarts = ImGui::Button("reset");
  ImGui::SameLine();
  choose_device(wishes);
  slide("speed", wishes.speed, 0.001, 10, "%.3g x");
  say("{:.4f} s   step {}   {} vertices", facts.time, facts.step, facts.vertices);
  if (wishes.is_paused)
    say("paused");
  else
    say("{:.0f} pictures a second, {}", facts.pictures_per_second,
        facts.factor == 1 ? "in step with real time" : fmt::format("{:.2g} x real time", facts.factor));
  say_muted(facts.device);
}

void edit_body(const std::string& name, Material& material) {
  if (!ImGui::TreeNode("body", "%s", name.c_str())) return;
  slide("stiffness", material.stiffness, 0.01, 1e5, "%.4g N/m");
  slide("mass", material.vertex_mass, 1e-3, 1e3, "%.4g kg");
  slide("damping", material.damping, 0, 100, "%.4g kg/s");
  ImGui::TreePop();
}

void edit_bodies(const Facts& facts, Wishes& wishes) {
  if (!ImGui::CollapsingHeader("Bodies", ImGuiTreeNodeFlags_DefaultOpen)) return;
  for (std::size_t b = 0; b < facts.bodies.size(); ++b) {
    ImGui::PushID(static_cast<int>(b));
    edit_body(facts.bodies[b], wishes.settings.materials[b]);
    ImGui::PopID();
  }
  slide("elasticity", wishes.settings.elasticity, 0, 1, "%.2f", false);
  slide("friction", wishes.settings.friction, 0, 2, "%.2f", false);
  bool restores = wishes.settings.restitution.has_value();
  if (ImGui::Checkbox("restitution", &restores)) wishes.settings.restitution = restores ? std::optional(0.5) : std::nullopt;
  if (!restores) return;
  ImGui::SameLine();
  slide("##restitution", *wishes.settings.restitution, 0, 1, "%.2f", false);
}

void choose_integrator(std::string& chosen) {
  if (!ImGui::BeginCombo("integrator", chosen.c_str())) return;
  for (const Integrator& integrator : integrators())
    if (ImGui::Selectable(std::string(integrator.name).c_str(), integrator.name == chosen)) chosen = integrator.name;
  ImGui::EndCombo();
}

void choose_step(const Facts& facts, Settings& settings) {
  bool by_tolerance = settings.tolerance.has_value();
  if (ImGui::Checkbox("steps by a tolerance", &by_tolerance)) {
    settings.tolerance = by_tolerance ? std::optional(1e-5) : std::nullopt;
    settings.time_step.reset();
  }
  if (by_tolerance) return void(slide("tolerance", *settings.tolerance, 1e-9, 1e-2, "%.1e"));
  bool is_automatic = !settings.time_step;
  double step = settings.time_step.value_or(facts.time_step);
  slide("time step", step, 1e-5, 0.1, "%.6f s");
  if (step != settings.time_step.value_or(facts.time_step)) settings.time_step = step;
  if (ImGui::Checkbox("automatic step", &is_automatic))
    settings.time_step = is_automatic ? std::nullopt : std::optional(facts.time_step);
}

void choose_damping(DampingLaw& law) {
  constexpr std::array laws = {DampingLaw::none, DampingLaw::constant, DampingLaw::adaptive, DampingLaw::internal};
  if (!ImGui::BeginCombo("damping law", name_of(law))) return;
  for (const DampingLaw one : laws)
    if (ImGui::Selectable(name_of(one), one == law)) law = one;
  ImGui::EndCombo();
}

void edit_method(const Facts& facts, Wishes& wishes) {
  if (!ImGui::CollapsingHeader("Method", ImGuiTreeNodeFlags_DefaultOpen)) return;
  choose_integrator(wishes.settings.integrator);
  choose_step(facts, wishes.settings);
  choose_damping(wishes.settings.damping_law);
}

void plot(const char* id, const Series& series, const std::string& text) {
  const std::vector<float>& values = series.values();
  float high = values.empty() ? 1 : *std::ranges::max_element(values);
  const float low = values.empty() ? 0 : std::min(0.0f, *std::ranges::min_element(values));
  if (high <= low) high = low + 1;
  ImGui::PlotLines(id, values.data(), static_cast<int>(values.size()), 0, text.c_str(), low, high * 1.15f,
                   {ImGui::GetContentRegionAvail().x, scaled(plot_height)});
}

void plot_energy(const Observation& seen) {
  if (!seen.energy_is_known) return say_muted("too many springs to measure the energy live");
  const std::vector<float>& energy = seen.energy.values();
  plot("##energy", seen.energy, energy.empty() ? "energy" : fmt::format("energy {:.5g} J", energy.back()));
}

void tell_what_happens(const Observation& seen) {
  if (!ImGui::CollapsingHeader("Energy and contacts", ImGuiTreeNodeFlags_DefaultOpen)) return;
  plot_energy(seen);
  const std::vector<float>& touching = seen.touching.values();
  plot("##contacts", seen.touching, fmt::format("contacts {:g}", touching.empty() ? 0 : touching.back()));
}

void tell_of_work(const Facts& facts, Wishes& wishes) {
  if (!ImGui::CollapsingHeader("Work")) return;
  say("a step takes {:.3g} ms", facts.observation->step_milliseconds);
  ImGui::Checkbox("time each pass (slower)", &wishes.times_passes);
  for (const PassTime& pass : facts.observation->passes) say("{:>9.4f} ms  {}", pass.milliseconds, pass.name);
  const StepReport& report = facts.report;
  say("forces     {:>8} made {:>8} skipped", report.force_evaluations, report.forces_skipped);
  say("bodies at rest {:>18} skipped", report.steps_at_rest);
  say("bodies asleep {:>19} skipped", report.steps_asleep);
  say("body pairs {:>22} skipped", report.body_pairs_skipped);
  say("tree refits{:>22} skipped", report.refits_skipped);
  if (const auto& clusters = report.clusters) {
    say("clusters' error{:>18.2g}", clusters->largest_error);
    say("clusters listed {:>17} times anew", clusters->lists_made);
    say("bodies all summed {:>15}", clusters->direct.size());
  }
}

void choose_level(unsigned deepest, std::optional<unsigned>& level) {
  bool has_boxes = level.has_value();
  ImGui::Checkbox("boxes of level", &has_boxes);
  if (!has_boxes) return level.reset();
  int chosen = static_cast<int>(level.value_or(std::min(2u, deepest)));
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  ImGui::SliderInt("##level", &chosen, 0, static_cast<int>(deepest), "%d", by_mouse);
  level = static_cast<unsigned>(chosen);
}

void choose_look(const Facts& facts, Shows& shows) {
  if (!ImGui::CollapsingHeader("Look", ImGuiTreeNodeFlags_DefaultOpen)) return;
  int colors = static_cast<int>(shows.colors);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("colour by");
  ImGui::PushID("colour");  // another control of the panel is labelled "speed", too
  for (const auto& [name, value] :
       {std::pair{"body", Colors::body}, {"deformation", Colors::deformation}, {"speed", Colors::speed}}) {
    ImGui::SameLine();
    ImGui::RadioButton(name, &colors, static_cast<int>(value));
  }
  ImGui::PopID();
  shows.colors = static_cast<Colors>(colors);
  ImGui::Checkbox("wireframe", &shows.wireframe);
  ImGui::SameLine();
  ImGui::Checkbox("velocities", &shows.velocities);
  ImGui::SameLine();
  ImGui::Checkbox("contacts", &shows.contacts);
  choose_level(facts.deepest_level, shows.tree_level);
}

// Shows the message at the picture's bottom right, where it moves nothing else.
void show_message(const glm::uvec2& size, const std::string& message) {
  if (message.empty()) return;
  const ImVec2 corner(static_cast<float>(size.x) - scaled(margin), static_cast<float>(size.y) - scaled(margin));
  ImGui::SetNextWindowPos(corner, ImGuiCond_Always, {1, 1});
  ImGui::SetNextWindowSize({std::min(scaled(width), corner.x - scaled(margin)), 0});
  ImGui::Begin("message", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::PushStyleColor(ImGuiCol_Text, {1, 0.72f, 0.35f, 1});
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(message.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  ImGui::End();
}

void show_help(const glm::uvec2& size, const std::string& help) {
  if (help.empty()) return;
  ImGui::SetNextWindowPos({static_cast<float>(size.x) - scaled(margin), scaled(margin)}, ImGuiCond_Always, {1, 0});
  ImGui::Begin("Keys and mouse", nullptr,
               ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove);
  ImGui::TextUnformatted(help.c_str());
  ImGui::End();
}

// What a number is edited with, beside characters.
using TypingKey = std::pair<std::string_view, ImGuiKey_>;
constexpr TypingKey typing_keys[] = {{"enter", ImGuiKey_Enter},         {"escape", ImGuiKey_Escape}, {"tab", ImGuiKey_Tab},
                                     {"backspace", ImGuiKey_Backspace}, {"delete", ImGuiKey_Delete}, {"left", ImGuiKey_LeftArrow},
                                     {"right", ImGuiKey_RightArrow}};

}  // namespace

/// The state of the mouse's buttons for ImGui's next picture, and the windows of the latest one.
struct Panel::Mouse {
  std::array<bool, 2> is_down{};
  std::vector<ImRect> windows;  // of the latest picture [pixels]

  void find_windows() {
    windows.clear();
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
      if (window->Active && !window->Hidden && (window->Flags & ImGuiWindowFlags_NoMouseInputs) == 0)
        windows.push_back(window->Rect());
  }
  /// ImGui itself can only tell for the place of the mouse in the latest picture.
  [[nodiscard]] bool is_over_window() const {
    return std::ranges::any_of(windows, [](const ImRect& window) { return window.Contains(ImGui::GetIO().MousePos); });
  }
  /// An open list takes every press, because a press beside it closes it.
  [[nodiscard]] bool takes_press() const {
    return is_over_window() || (!windows.empty() && !ImGui::GetCurrentContext()->OpenPopupStack.empty());
  }
};

Panel::Panel(float scale) : mouse_(std::make_unique<Mouse>()) {
  begin_style(scale, text_height);
  for (const auto& [name, key] : typing_keys) ImGui::GetIO().KeyMap[key] = key;  // as an index of KeysDown
}

Panel::~Panel() { end_style(); }

// Keys that write nothing are down for one picture. ImGui's own `WantTextInput` lags a picture behind what has the focus.
bool Panel::types(const std::string& key) {
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  if (context.ActiveId == 0 || context.ActiveId != context.InputTextState.ID) return false;
  ImGuiIO& io = ImGui::GetIO();
  const auto found = std::ranges::find(typing_keys, key, &TypingKey::first);
  if (found != std::end(typing_keys))
    io.KeysDown[found->second] = true;
  else if (key.size() == 1)
    io.AddInputCharacter(static_cast<unsigned>(std::tolower(static_cast<unsigned char>(key[0]))));
  return true;
}

bool Panel::takes(const WindowEvent& event) {
  ImGuiIO& io = ImGui::GetIO();
  if (const auto* key = std::get_if<KeyPressed>(&event)) return types(key->name);
  const auto at = [&](const glm::dvec2& place) { io.MousePos = {static_cast<float>(place.x), static_cast<float>(place.y)}; };
  if (const auto* moved = std::get_if<MouseMoved>(&event)) {
    at(moved->to);
    return mouse_->is_down[0] || mouse_->is_down[1];
  }
  if (const auto* pressed = std::get_if<MousePressed>(&event)) {
    at(pressed->place);
    if (!mouse_->takes_press()) return false;
    io.KeyCtrl = pressed->with_control;
    return mouse_->is_down[static_cast<std::size_t>(pressed->button)] = true;
  }
  if (const auto* released = std::get_if<MouseReleased>(&event))
    return std::exchange(mouse_->is_down[static_cast<std::size_t>(released->button)], false);
  const auto* scrolled = std::get_if<MouseScrolled>(&event);
  if (scrolled == nullptr || !mouse_->is_over_window()) return false;
  io.MouseWheel += static_cast<float>(scrolled->notches);
  return true;
}

void Panel::begin(const glm::uvec2& size, double seconds) {
  std::ranges::copy(mouse_->is_down, ImGui::GetIO().MouseDown);
  begin_picture(size, seconds);
}

void Panel::end() {
  end_picture();
  std::ranges::fill(ImGui::GetIO().KeysDown, false);
  ImGui::GetIO().KeyCtrl = false;  // characters would count as shortcuts
  mouse_->find_windows();
}

void Panel::draw(const glm::uvec2& size, double seconds, const Facts& facts, Wishes& wishes, const std::string& help) {
  begin(size, seconds);
  const ImRect place(scaled(margin), scaled(margin), scaled(margin + width), static_cast<float>(size.y) - scaled(margin));
  ImGui::SetNextWindowPos(place.Min);
  ImGui::SetNextWindowSize({place.GetWidth(), 0});
  ImGui::SetNextWindowSizeConstraints({place.GetWidth(), 0}, place.GetSize());
  ImGui::Begin((facts.title + "###panel").c_str(), nullptr, ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse);
  ImGui::PushItemWidth(-scaled(95));
  choose_scene(facts, wishes);
  save_scene(wishes);
  play(facts, wishes);
  edit_bodies(facts, wishes);
  edit_method(facts, wishes);
  tell_what_happens(*facts.observation);
  tell_of_work(facts, wishes);
  choose_look(facts, wishes.shows);
  ImGui::PopItemWidth();
  const bool has_no_height_yet = ImGui::IsWindowAppearing();
  ImGui::End();
  show_message(size, facts.message);
  show_help(size, help);
  end();
  if (has_no_height_yet) mouse_->windows.push_back(place);
}

void Panel::draw_help(const glm::uvec2& size, double seconds, const std::string& help) {
  begin(size, seconds);
  show_help(size, help);
  end();
}

void Panel::hide() { mouse_->windows.clear(); }

std::size_t Panel::window_count() const { return mouse_->windows.size(); }

}  // namespace pliant::view
