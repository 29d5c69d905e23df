#include "window/style.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace pliant::view {

void begin_style(float scale, float text_height) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // leaves no file behind
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = style.FrameRounding = style.GrabRounding = 4;
  style.WindowBorderSize = 0;
  style.Colors[ImGuiCol_WindowBg] = {0.07f, 0.08f, 0.10f, 0.88f};
  style.Colors[ImGuiCol_PlotLines] = {0.95f, 0.62f, 0.25f, 1};
  style.ScaleAllSizes(scale);
  ImFontConfig font;
  font.SizePixels = std::round(text_height * scale);
  ImGui::GetIO().Fonts->AddFontDefault(&font);
  ImGui_ImplOpenGL3_Init("#version 450");
}

void end_style() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
}

void begin_picture(const glm::uvec2& size, double seconds) {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(size.x), static_cast<float>(size.y)};
  io.DeltaTime = static_cast<float>(std::clamp(seconds, 1e-4, 0.1));
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
}

void end_picture() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace pliant::view
