// `pliant view` in a real window, driven through X by keys and mouse. Nothing here waits for a time: the program reports each
// picture, and a test reads until what it did shows.
#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "support/display.hpp"
#include "support/json.hpp"
#include "support/pictures.hpp"
#include "support/scratch.hpp"

namespace pliant::test {

inline glm::dvec3 place(const ReadJson& json) { return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()}; }
inline glm::dvec3 eye_from_target(const ReadJson& line) { return place(line["camera"]["eye"]) - place(line["camera"]["target"]); }

inline bool has_turned_by_a_quarter(const ReadJson& before, const ReadJson& after) {
  const glm::dvec3 old = eye_from_target(before);
  return glm::distance(eye_from_target(after), glm::dvec3(-old.z, old.y, old.x)) < 1e-6 * glm::length(old);
}

/// How long a test waits for what it wants to read. The program may say nothing for as long (display.cpp).
constexpr std::chrono::minutes longest_wait{10};

/// The program in its window. Leaks are not looked for, because the driver's libraries leave some. They are unloaded with the
/// window, so no suppression knows their names afterwards.
class Viewed {
 public:
  /// Starts the program paused, with a small scene and `more` options.
  Viewed(const VirtualDisplay& display, const ScratchFolder& folder, const std::string& device,
         const std::vector<std::string>& more = {});

  /// Runs commands of xdotool.
  void xdotool(const std::string& commands) const { (void)display_.run("xdotool " + commands); }
  [[nodiscard]] std::string move_to(const glm::ivec2& at) const {
    return "mousemove --window " + window_ + " " + std::to_string(at.x) + " " + std::to_string(at.y) + " ";
  }
  void press(const std::string& key) const { xdotool("key " + key); }
  void drag(int button, const glm::ivec2& from, const glm::ivec2& to) const {
    xdotool(move_to(from) + "mousedown " + std::to_string(button) + " " + move_to(to) + "mouseup " + std::to_string(button));
  }
  void click(const glm::ivec2& at) const { xdotool(move_to(at) + "click 1"); }
  void drop(const std::filesystem::path& file) const { display_.drop(file, window_); }
  /// Reads reports until one is as wanted.
  ReadJson await(const std::function<bool(const ReadJson&)>& is_wanted, std::chrono::minutes at_most = longest_wait);
  /// Reads lines until one begins with this.
  std::string await_text(const std::string& beginning);
  /// The picture that the program saves.
  render::Image saved_picture();
  /// Whether the window shows the picture. Waits for it, because it may still be on its way to the display.
  [[nodiscard]] bool shows(const render::Image& picture) const;
  [[nodiscard]] bool shows_another(const render::Image& picture) const;
  const std::string& window() const { return window_; }
  Child& program() { return program_; }

 private:
  std::string await_line(const std::function<bool(const std::string&)>& is_wanted, std::chrono::minutes at_most);

  const VirtualDisplay& display_;
  std::filesystem::path folder_;
  Child program_;
  std::string window_;  // its number
};

inline auto step_is(std::uint64_t step) {
  return [step](const ReadJson& line) { return line["step"] == step; };
}
inline auto size_is(unsigned width, unsigned height) {
  return [=](const ReadJson& line) { return line["size"] == std::vector<ReadJson>{width, height}; };
}

/// The pixels of the red body: how many there are, and where they are on average.
struct Reddish {
  explicit Reddish(const render::Image& image) {
    for (std::size_t i = 0; i < image.pixels.size() / 3; ++i) {
      if (image.pixels[3 * i] <= 2 * image.pixels[3 * i + 2]) continue;
      ++count;
      sum += glm::dvec2(i % image.width, i / image.width);
    }
  }
  [[nodiscard]] glm::ivec2 centre() const { return sum / static_cast<double>(count); }
  long count = 0;
  glm::dvec2 sum{0.0};
};

/// What a program without the viewer says of itself.
inline constexpr const char* built_without = "built without the viewer";

/// Says why no window can be tested here, if so, and fails under CI.
[[nodiscard]] bool is_skipped();

}  // namespace pliant::test
