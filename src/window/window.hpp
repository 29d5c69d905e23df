// A window that shows what OpenGL draws. It gives its user's actions as plain data.
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
  /// What the key writes in the keyboard's layout, in capitals, or "space", "tab", "escape", "enter",
  /// "backspace", "delete", "left", "right" or "F1" to "F12".
  std::string name;
  bool is_repeat = false;  // the key is being held
};
struct MousePressed {
  MouseButton button;
  glm::dvec2 place;  // here and below: [pixels] of the framebuffer from the top left
  bool with_control = false;
};
struct MouseReleased {
  MouseButton button;
};
struct MouseMoved {
  glm::dvec2 from, to;
  std::optional<MouseButton> held;
};
struct MouseScrolled {
  double notches;  // away from the user is positive
};
struct FilesDropped {
  std::vector<std::filesystem::path> files;  // at least one
};
struct PictureNeeded {};  // the window was resized, uncovered, minimised or restored

using WindowEvent = std::variant<KeyPressed, MousePressed, MouseReleased, MouseMoved, MouseScrolled, FilesDropped, PictureNeeded>;

/// There may be only one window at a time. Only the thread that made it may use it.
class Window {
 public:
  /// `size` is the size of the content on a display of usual density [pixels]. Swaps wait for the display's refresh. Throws Error
  /// (device) if there is no display, or no OpenGL 4.5 on it.
  Window(const glm::uvec2& size, const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Returns the window's own context, which is current on this thread.
  [[nodiscard]] gl::Context& context();
  /// Returns the size to draw [pixels]. It is 0 x 0 while there is nothing to draw into, for example while minimised.
  [[nodiscard]] glm::uvec2 framebuffer_size() const;
  /// Returns how much larger than on a usual display texts and controls should be, such as 2. The window itself already is.
  [[nodiscard]] float scale() const;
  /// Returns the events since the last call.
  [[nodiscard]] std::vector<WindowEvent> poll_events();
  /// Waits until something happens or `seconds` have gone by, and returns the events since the last call.
  [[nodiscard]] std::vector<WindowEvent> wait_for_events(double seconds);
  /// Returns whether its user or close() has closed it.
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
