// The window through GLFW, which nothing else here includes.
#include "gl/window.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "core/error.hpp"

namespace pliant::gl {
namespace {

constexpr const char* remedy = "`pliant run SCENE --frames png` draws without a window";

std::string latest_problem() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text == nullptr ? "no reason given" : text;
}

/// GLFW, once initialised, for as long as the window lives.
struct Library {
  Library() {
    if (!glfwInit()) throw Error(ErrorKind::device, "", "there is no display for a window: " + latest_problem(), remedy);
  }
  ~Library() { glfwTerminate(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

void ask_for_opengl() {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);  // pictures have their own
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
}

GLFWwindow* make_window(const glm::uvec2& size, const std::string& title) {
  ask_for_opengl();
  GLFWwindow* window = glfwCreateWindow(static_cast<int>(size.x), static_cast<int>(size.y), title.c_str(), nullptr, nullptr);
  if (window == nullptr)
    throw Error(ErrorKind::device, "", "this display gives no window with OpenGL 4.5: " + latest_problem(), remedy);
  return window;
}

WindowContext context_of(GLFWwindow* window) {
  return {.find = glfwGetProcAddress, .make_current = [window] { glfwMakeContextCurrent(window); }};
}

std::optional<Key> named_key(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, Key>, 5> names = {
      {{".", Key::period}, {",", Key::comma}, {"f", Key::f}, {"r", Key::r}, {"w", Key::w}}};
  for (const auto& [known, key] : names)
    if (name == known) return key;
  return {};
}

std::optional<Key> key_of(int key, int scancode) {
  switch (key) {
    case GLFW_KEY_SPACE:
      return Key::space;
    case GLFW_KEY_ESCAPE:
      return Key::escape;
    case GLFW_KEY_F1:
      return Key::f1;
    case GLFW_KEY_F12:
      return Key::f12;
    default: {
      const char* name = glfwGetKeyName(key, scancode);
      return name == nullptr ? std::nullopt : named_key(name);
    }
  }
}

}  // namespace

struct Window::Impl {
  Impl(const glm::uvec2& size, const std::string& title) : window(make_window(size, title)), context(context_of(window)) {
    glfwSetWindowUserPointer(window, this);
    glfwSwapInterval(1);
    listen();
  }
  ~Impl() { glfwDestroyWindow(window); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  static Impl& of(GLFWwindow* window) { return *static_cast<Impl*>(glfwGetWindowUserPointer(window)); }
  void listen();
  void move_cursor(const glm::dvec2& place);
  [[nodiscard]] bool holds(int button) const { return glfwGetMouseButton(window, button) == GLFW_PRESS; }

  Library library;
  GLFWwindow* window;
  Context context;
  std::vector<WindowEvent> events;
  std::optional<glm::dvec2> cursor;  // where it was last seen [screen units]
};

void Window::Impl::listen() {
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int scancode, int action, int) {
    const std::optional<Key> known = action == GLFW_RELEASE ? std::nullopt : key_of(key, scancode);
    if (known) of(w).events.emplace_back(KeyPressed{*known});
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { of(w).move_cursor({x, y}); });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double y) { of(w).events.emplace_back(MouseScrolled{y}); });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    if (count > 0) of(w).events.emplace_back(FilesDropped{{paths, paths + count}});
  });
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { of(w).events.emplace_back(PictureNeeded{}); });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { of(w).events.emplace_back(PictureNeeded{}); });
  glfwSetWindowIconifyCallback(window, [](GLFWwindow* w, int) { of(w).events.emplace_back(PictureNeeded{}); });
}

void Window::Impl::move_cursor(const glm::dvec2& place) {
  const glm::dvec2 before = std::exchange(cursor, place).value_or(place);
  int width = 0, height = 0, pixels_across = 0, pixels_down = 0;
  glfwGetWindowSize(window, &width, &height);
  glfwGetFramebufferSize(window, &pixels_across, &pixels_down);
  if (width <= 0 || height <= 0) return;
  const glm::dvec2 pixels(static_cast<double>(pixels_across) / width, static_cast<double>(pixels_down) / height);
  if (holds(GLFW_MOUSE_BUTTON_LEFT))
    events.emplace_back(MouseDragged{MouseButton::left, before * pixels, place * pixels});
  else if (holds(GLFW_MOUSE_BUTTON_RIGHT))
    events.emplace_back(MouseDragged{MouseButton::right, before * pixels, place * pixels});
}

Window::Window(const glm::uvec2& size, const std::string& title) : impl_(std::make_unique<Impl>(size, title)) {}

Window::~Window() = default;

Context& Window::context() { return impl_->context; }

glm::uvec2 Window::framebuffer_size() const {
  if (glfwGetWindowAttrib(impl_->window, GLFW_ICONIFIED)) return {0, 0};
  int width = 0, height = 0;
  glfwGetFramebufferSize(impl_->window, &width, &height);
  return width > 0 && height > 0 ? glm::uvec2(width, height) : glm::uvec2(0, 0);
}

std::vector<WindowEvent> Window::poll_events() {
  glfwPollEvents();
  return std::exchange(impl_->events, {});
}

std::vector<WindowEvent> Window::wait_for_events(double seconds) {
  glfwWaitEventsTimeout(seconds);
  return std::exchange(impl_->events, {});
}

bool Window::is_closed() const { return glfwWindowShouldClose(impl_->window); }

void Window::close() { glfwSetWindowShouldClose(impl_->window, GLFW_TRUE); }

void Window::set_title(const std::string& title) { glfwSetWindowTitle(impl_->window, title.c_str()); }

void Window::swap() { glfwSwapBuffers(impl_->window); }

}  // namespace pliant::gl
