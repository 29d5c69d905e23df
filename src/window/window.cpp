// Makes the window with GLFW, which nothing else includes.
#include "window/window.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>
#include <utility>

#include "core/error.hpp"

namespace pliant::view {
namespace {

constexpr const char* remedy = "`pliant run SCENE --frames png` draws without a window";

std::string latest_problem() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text == nullptr ? "no reason given" : text;
}

/// Initialises GLFW and terminates it with the window.
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
  glfwWindowHint(GLFW_DEPTH_BITS, 0);  // pictures have their own depths
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

gl::WindowContext context_of(GLFWwindow* window) {
  return {.find = glfwGetProcAddress, .make_current = [window] { glfwMakeContextCurrent(window); }};
}

// Returns the name of a key that writes nothing, or an empty text if pliant has no name for it.
std::string name_of_key(int key) {
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return std::string("F").append(std::to_string(key - GLFW_KEY_F1 + 1));
  static constexpr std::pair<int, const char*> names[] = {
      {GLFW_KEY_TAB, "tab"},        {GLFW_KEY_ESCAPE, "escape"},       {GLFW_KEY_ENTER, "enter"},
      {GLFW_KEY_KP_ENTER, "enter"}, {GLFW_KEY_BACKSPACE, "backspace"}, {GLFW_KEY_DELETE, "delete"},
      {GLFW_KEY_LEFT, "left"},      {GLFW_KEY_RIGHT, "right"}};
  const auto found = std::ranges::find(names, key, &std::pair<int, const char*>::first);
  return found != std::end(names) ? found->second : "";
}

// Returns the name of a key that writes a character: that character in capitals. If it is not Latin, the name is the letter at
// the key's place on a US keyboard.
std::string name_of_character(unsigned character, int key) {
  if (character == ' ') return "space";
  if (character > ' ' && character < 0x7f) return {static_cast<char>(std::toupper(static_cast<int>(character)))};
  return key >= GLFW_KEY_A && key <= GLFW_KEY_Z ? std::string{static_cast<char>(key)} : "";
}

}  // namespace

struct Window::Impl {
  Impl(const glm::uvec2& size, const std::string& title) : window(make_window(size, title)), context(context_of(window)) {
    glfwSetWindowUserPointer(window, this);
    glfwSwapInterval(1);
    measure();
    listen();
  }
  ~Impl() { glfwDestroyWindow(window); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  static Impl& of(GLFWwindow* window) { return *static_cast<Impl*>(glfwGetWindowUserPointer(window)); }
  void listen();
  void measure();
  void press_key(int key, int action, int modifiers);
  void write(unsigned character);
  void press_mouse(int button, int action, int modifiers);
  void move_cursor(const glm::dvec2& place);

  Library library;
  GLFWwindow* window;
  gl::Context context;
  std::vector<WindowEvent> events;
  glm::uvec2 framebuffer_size{0};     // 0 x 0 while minimised
  glm::dvec2 pixels{1.0};             // pixels of a screen unit
  int latest_key = GLFW_KEY_UNKNOWN;  // pressed last
  bool is_repeating = false;          // latest_key is held
  std::optional<MouseButton> held;    // pressed last and not released since
  std::optional<glm::dvec2> cursor;   // where it was last seen [pixels]
};

void Window::Impl::listen() {
  glfwSetKeyCallback(window,
                     [](GLFWwindow* w, int key, int, int action, int modifiers) { of(w).press_key(key, action, modifiers); });
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned character) { of(w).write(character); });
  glfwSetMouseButtonCallback(
      window, [](GLFWwindow* w, int button, int action, int modifiers) { of(w).press_mouse(button, action, modifiers); });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { of(w).move_cursor({x, y}); });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double y) { of(w).events.emplace_back(MouseScrolled{y}); });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    if (count > 0) of(w).events.emplace_back(FilesDropped{{paths, paths + count}});
  });
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { of(w).events.emplace_back(PictureNeeded{}); });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { of(w).measure(); });
  glfwSetWindowIconifyCallback(window, [](GLFWwindow* w, int) { of(w).measure(); });
}

// Asks the display only when something changes, because asking takes a while.
void Window::Impl::measure() {
  int width = 0, height = 0, pixels_across = 0, pixels_down = 0;
  glfwGetWindowSize(window, &width, &height);
  glfwGetFramebufferSize(window, &pixels_across, &pixels_down);
  const bool is_shown = !glfwGetWindowAttrib(window, GLFW_ICONIFIED) && pixels_across > 0 && pixels_down > 0;
  framebuffer_size = is_shown ? glm::uvec2(pixels_across, pixels_down) : glm::uvec2(0);
  if (width > 0 && height > 0) pixels = glm::dvec2(pixels_across, pixels_down) / glm::dvec2(width, height);
  events.emplace_back(PictureNeeded{});
}

// Ignores keys with Control, Alt or Super, which belong to the desktop. Keys that write a character arrive in write().
void Window::Impl::press_key(int key, int action, int modifiers) {
  if (action == GLFW_RELEASE) return;
  latest_key = key;
  is_repeating = action == GLFW_REPEAT;
  if ((modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER)) != 0) return;
  if (std::string name = name_of_key(key); !name.empty()) events.emplace_back(KeyPressed{std::move(name), is_repeating});
}

void Window::Impl::write(unsigned character) {
  if (std::string name = name_of_character(character, latest_key); !name.empty())
    events.emplace_back(KeyPressed{std::move(name), is_repeating});
}

void Window::Impl::press_mouse(int number, int action, int modifiers) {
  if (number != GLFW_MOUSE_BUTTON_LEFT && number != GLFW_MOUSE_BUTTON_RIGHT) return;
  const MouseButton button = number == GLFW_MOUSE_BUTTON_LEFT ? MouseButton::left : MouseButton::right;
  if (action == GLFW_RELEASE) {
    if (held == button) held.reset();
    events.emplace_back(MouseReleased{button});
    return;
  }
  held = button;
  events.emplace_back(MousePressed{button, cursor.value_or(glm::dvec2(0.0)), (modifiers & GLFW_MOD_CONTROL) != 0});
}

void Window::Impl::move_cursor(const glm::dvec2& place) {
  const glm::dvec2 to = place * pixels;
  events.emplace_back(MouseMoved{cursor.value_or(to), to, held});
  cursor = to;
}

Window::Window(const glm::uvec2& size, const std::string& title) : impl_(std::make_unique<Impl>(size, title)) {}

Window::~Window() = default;

gl::Context& Window::context() { return impl_->context; }

glm::uvec2 Window::framebuffer_size() const { return impl_->framebuffer_size; }

float Window::scale() const {
  float across = 1, down = 1;
  glfwGetWindowContentScale(impl_->window, &across, &down);
  return across;
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

}  // namespace pliant::view
