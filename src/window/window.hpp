// A window that shows what OpenGL draws, and what its user does to it, as plain data.
#pragma once
#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "gl/context.hpp"

namespace pliant::view {

enum class MouseButton { left, right };

struct KeyPressed {
  std::string name;        // what the keyboard's layout writes by it, in capitals, or "space", "tab", "escape", "F1" to "F12"
  bool is_repeat = false;  // it is being held
};
struct MousePressed {
  MouseButton button;
  glm::dvec2 place;  // here and below: pixels of the framebuffer from the top left
  bool with_control = false;
};
struct MouseReleased {
  MouseButton button;
};
struct MouseMoved {  // between two events
  glm::dvec2 from, to;
  std::optional<MouseButton> held;
};
struct MouseScrolled {
  double notches;  // away from the user is positive
};
struct FilesDropped {
  std::vector<std::filesystem::path> files;  // one at least
};
struct PictureNeeded {};  // the window was resized, uncovered, minimised or restored

using WindowEvent = std::variant<KeyPressed, MousePressed, MouseReleased, MouseMoved, MouseScrolled, FilesDropped, PictureNeeded>;

/// One at a time; all of it belongs to the thread that made it.
class Window {
 public:
  /// `size` is that of the content on a display of usual density [pixels]. Swaps wait for the display's refresh. Throws Error
  /// (device) where there is no display, or no OpenGL 4.5 on it.
  Window(const glm::uvec2& size, const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// The window's own, current on this thread.
  [[nodiscard]] gl::Context& context();
  /// [pixels]; 0 x 0 while there is nothing to draw into, as when minimised.
  [[nodiscard]] glm::uvec2 framebuffer_size() const;
  /// How much larger than on a usual display its user wants what is drawn, such as 2: the window was made larger so itself.
  [[nodiscard]] float scale() const;
  /// What happened since the last call.
  [[nodiscard]] std::vector<WindowEvent> poll_events();
  /// The same, but waits until something happens or `seconds` have gone by.
  [[nodiscard]] std::vector<WindowEvent> wait_for_events(double seconds);
  /// Whether it was closed, by its user or by close().
  [[nodiscard]] bool is_closed() const;
  void close();
  void set_title(const std::string& title);
  /// Shows what was drawn.
  void swap();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pliant::view
