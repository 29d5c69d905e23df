#include "support/viewed.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>

#include "support/has.hpp"
#include "support/paths.hpp"
#include "support/program.hpp"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#include <stb/stb_image.h>

namespace pliant::test {
namespace {

// Two small spheres, one of them on its way to the other.
std::filesystem::path scene_to_view(const ScratchFolder& folder) {
  const auto file = folder.path / "small.toml";
  std::ofstream(file)
      << "title = \"Small\"\n[simulation]\ntime_step = 0.01\n[output]\nsize = [320, 240]\n"
         "[[body]]\nmesh = \"icosphere:1\"\nposition = [-1.3, 0, 0]\nvelocity = [0.5, 0, 0]\ncolor = [0.8, 0.1, 0.05]\n"
         "[[body]]\nmesh = \"icosphere:1\"\nposition = [1.3, 0, 0]\ncolor = [0.05, 0.1, 0.8]\n";
  return file;
}

render::Image load_png(const std::filesystem::path& file) {
  int width = 0, height = 0, channels = 0;
  stbi_uc* pixels = stbi_load(file.c_str(), &width, &height, &channels, 3);
  REQUIRE(pixels != nullptr);
  render::Image image{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
  image.pixels.assign(pixels, pixels + 3 * width * height);
  stbi_image_free(pixels);
  return image;
}

std::vector<std::string> command(const std::filesystem::path& scene, const std::string& device,
                                 const std::vector<std::string>& more) {
  std::vector<std::string> command = {
      "sh",       "-c",         "exec \"$0\" \"$@\" 2>&1", program_path(), "view", scene.string(), "--paused", "--device", device,
      "--report", "/dev/stdout"};
  command.insert(command.end(), more.begin(), more.end());
  return command;
}

/// Why no window can be tested here. Empty if it can.
std::string obstacle() {
  const ProgramResult result = run_program("view " + shipped_scene("two_spheres"), "env -u DISPLAY -u WAYLAND_DISPLAY ");
  if (result.output.find(built_without) != std::string::npos) return "this program was built without the viewer";
  const std::string missing = VirtualDisplay::missing();
  REQUIRE((missing.empty() || std::getenv("CI") == nullptr));
  return missing.empty() ? "" : "there is no " + missing;
}

}  // namespace

Viewed::Viewed(const VirtualDisplay& display, const ScratchFolder& folder, const std::string& device,
               const std::vector<std::string>& more)
    : display_(display),
      folder_(folder.path),
      program_(command(scene_to_view(folder), device, more),
               {{"DISPLAY", display.name()}, {"LIBGL_ALWAYS_SOFTWARE", "1"}, {"ASAN_OPTIONS", "detect_leaks=0"}}, folder.path) {
  await([](const ReadJson&) { return true; });
  window_ = display.run("xdotool search --sync --onlyvisible --name 'Small - pliant'");
  window_.erase(window_.find_last_not_of('\n') + 1);
  xdotool("windowfocus --sync " + window_);
}

std::string Viewed::await_line(const std::function<bool(const std::string&)>& is_wanted, std::chrono::minutes at_most) {
  const auto began = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - began <= at_most)
    if (std::string line = program_.read_line(); is_wanted(line)) return line;
  throw std::runtime_error("no line was as wanted");
}

ReadJson Viewed::await(const std::function<bool(const ReadJson&)>& is_wanted, std::chrono::minutes at_most) {
  const auto is_wanted_report = [&](const std::string& line) {
    return line.starts_with('{') && is_wanted(ReadJson::parse(line));
  };
  return ReadJson::parse(await_line(is_wanted_report, at_most));
}

std::string Viewed::await_text(const std::string& beginning) {
  return await_line([&](const std::string& line) { return line.starts_with(beginning); }, longest_wait);
}

render::Image Viewed::saved_picture() {
  press("F12");
  const std::string line = await_text("saved ");
  return load_png(folder_ / line.substr(6));
}

bool Viewed::shows(const render::Image& picture) const {
  for (int look = 0; look < 200; ++look)
    if (const render::Image seen = display_.picture_of(window_); seen.width == picture.width && are_alike(seen, picture))
      return true;
  return false;
}

bool Viewed::shows_another(const render::Image& picture) const {
  for (int look = 0; look < 200; ++look)
    if (!are_alike(display_.picture_of(window_), picture)) return true;
  return false;
}

bool is_skipped() {
  const std::string why = obstacle();
  if (!why.empty()) skip(why);
  return !why.empty();
}

}  // namespace pliant::test
