// Makes contexts and says what they are. A display, once initialised, lives as long as the process. EGL hands out the same
// display to every Context of a device, so terminating it would pull it from under the others.
#include "gl/context.hpp"

#include <fmt/format.h>
#include <glad/egl.h>
#include <glad/gl.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <thread>

#include "core/error.hpp"

namespace pliant::gl {
namespace {

using namespace std::string_view_literals;

struct OpenAdapter {
  Adapter adapter;
  EGLDisplay display = EGL_NO_DISPLAY;
};

struct Discovery {
  std::vector<OpenAdapter> adapters;
  std::string reason;  // why nothing, or not everything, was found
};

/// Restores what is current on this thread at the end of a scope.
class KeepCurrent {
 public:
  KeepCurrent() : display_(eglGetCurrentDisplay()), context_(eglGetCurrentContext()) {}
  ~KeepCurrent() {
    if (context_ != EGL_NO_CONTEXT) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
  }
  KeepCurrent(const KeepCurrent&) = delete;
  KeepCurrent& operator=(const KeepCurrent&) = delete;

 private:
  EGLDisplay display_;
  EGLContext context_;
};

bool has_extension(EGLDisplay display, std::string_view name) {
  const char* all = eglQueryString(display, EGL_EXTENSIONS);
  return all != nullptr && fmt::format(" {} ", all).find(fmt::format(" {} ", name)) != std::string::npos;
}

EGLConfig choose_config(EGLDisplay display) {
  if (has_extension(display, "EGL_KHR_no_config_context")) return EGLConfig{};  // EGL_NO_CONFIG_KHR
  constexpr std::array<EGLint, 5> wanted = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
  EGLConfig config{};
  EGLint count = 0;
  eglChooseConfig(display, wanted.data(), &config, 1, &count);
  return config;
}

/// Returns EGL_NO_CONTEXT if the display can't give an OpenGL 4.5 core context without a surface.
EGLContext create_context(EGLDisplay display) {
  constexpr std::array<EGLint, 9> wanted = {EGL_CONTEXT_MAJOR_VERSION,
                                            4,
                                            EGL_CONTEXT_MINOR_VERSION,
                                            5,
                                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                            EGL_CONTEXT_OPENGL_DEBUG,
                                            EGL_TRUE,
                                            EGL_NONE};
  if (!has_extension(display, "EGL_KHR_surfaceless_context") || !eglBindAPI(EGL_OPENGL_API)) return EGL_NO_CONTEXT;
  return eglCreateContext(display, choose_config(display), EGL_NO_CONTEXT, wanted.data());
}

bool make_current_and_load(EGLDisplay display, EGLContext context) {
  return eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) && gladLoadGL(eglGetProcAddress) != 0;
}

std::string gl_string(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

bool is_software_renderer(const std::string& renderer) {
  constexpr std::array names = {"llvmpipe"sv, "softpipe"sv, "swrast"sv, "SWR"sv};
  return std::ranges::any_of(names, [&](std::string_view name) { return renderer.find(name) != std::string::npos; });
}

/// Returns a number that only drivers with an extension tell, which glad's loader leaves out. Returns 0 without it. Expects a
/// current context.
std::uint32_t number_of(std::string_view extension, GLenum name) {
  GLint extensions = 0, number = 0;
  glGetIntegerv(GL_NUM_EXTENSIONS, &extensions);
  for (GLuint k = 0; k < static_cast<GLuint>(extensions); ++k)
    if (reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, k)) == extension) glGetIntegerv(name, &number);
  return static_cast<std::uint32_t>(number);
}

/// Expects a current context.
std::uint32_t count_storage_blocks() {
  GLint blocks = 0, bindings = 0;
  glGetIntegerv(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, &blocks);
  glGetIntegerv(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, &bindings);
  return static_cast<std::uint32_t>(std::min(blocks, bindings));
}

/// Describes the current context.
Adapter describe_current(int index) {
  constexpr GLenum sm_count_nv = 0x933B, current_available_vidmem_nvx = 0x9049;  // the latter in KiB
  const std::string renderer = gl_string(GL_RENDERER);
  Adapter adapter{.index = index,
                  .renderer = renderer,
                  .vendor = gl_string(GL_VENDOR),
                  .version = gl_string(GL_VERSION),
                  .is_software = is_software_renderer(renderer),
                  .storage_blocks = count_storage_blocks(),
                  .multiprocessors = number_of("GL_NV_shader_thread_group", sm_count_nv),
                  .free_memory = std::uint64_t{1024} * number_of("GL_NVX_gpu_memory_info", current_available_vidmem_nvx)};
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &adapter.largest_buffer);
  if (!adapter.vendor.starts_with("NVIDIA")) adapter.free_memory = 0;  // others may count a part of the processor's memory alone
  return adapter;
}

/// Makes a context to learn what it is. Returns nothing and adds to `reason` if there is none.
std::optional<OpenAdapter> probe(EGLDisplay display, std::string_view place, std::string& reason) {
  const auto refuse = [&](std::string_view why) {
    reason += fmt::format("{}{}: {}", reason.empty() ? "" : "; ", place, why);
    return std::nullopt;
  };
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) return refuse("EGL cannot open it");
  gladLoaderLoadEGL(display);
  const KeepCurrent keep;
  const EGLContext context = create_context(display);
  if (context == EGL_NO_CONTEXT) return refuse("no OpenGL 4.5 core context without a window");
  std::optional<OpenAdapter> found;
  if (make_current_and_load(display, context)) found = OpenAdapter{describe_current(0), display};
  eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display, context);
  if (!found) return refuse("the OpenGL functions do not load");
  return found;
}

void probe_devices(Discovery& discovery) {
  if (!has_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") && !has_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base"))
    return;
  if (!has_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") || eglQueryDevicesEXT == nullptr) return;
  std::array<EGLDeviceEXT, 64> devices{};
  EGLint count = 0;
  if (!eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count)) return;
  for (EGLint i = 0; i < count; ++i) {
    const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr);
    if (auto found = probe(display, fmt::format("EGL device {}", i), discovery.reason)) discovery.adapters.push_back(*found);
  }
}

void probe_surfaceless(Discovery& discovery) {
  if (!has_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless") || eglGetPlatformDisplayEXT == nullptr) return;
  const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  const auto found = probe(display, "Mesa surfaceless", discovery.reason);
  if (!found) return;
  const auto same = [&](const OpenAdapter& other) { return other.adapter.renderer == found->adapter.renderer; };
  if (std::ranges::none_of(discovery.adapters, same)) discovery.adapters.push_back(*found);
}

Discovery discover() {
  Discovery discovery;
  if (gladLoaderLoadEGL(EGL_NO_DISPLAY) == 0) {
    discovery.reason = "libEGL.so.1 cannot be loaded";
    return discovery;
  }
  probe_devices(discovery);
  probe_surfaceless(discovery);
  std::ranges::stable_partition(discovery.adapters, [](const OpenAdapter& a) { return !a.adapter.is_software; });
  for (int index = 0; OpenAdapter & open : discovery.adapters) open.adapter.index = index++;
  if (discovery.adapters.empty() && discovery.reason.empty()) discovery.reason = "EGL lists no device";
  return discovery;
}

/// Making contexts takes a while, so every device is asked once.
const Discovery& discovery() {
  static const Discovery found = discover();
  return found;
}

const OpenAdapter& open_adapter(int index) {
  const auto& [adapters, reason] = discovery();
  if (index >= 0 && index < static_cast<int>(adapters.size())) return adapters[index];
  throw Error(ErrorKind::device, "",
              adapters.empty() ? fmt::format("no OpenGL 4.5 device was found ({})", reason)
                               : fmt::format("there is no GPU {}; {} found", index, adapters.size()),
              adapters.empty() ? "install a driver with EGL (Mesa: apt install libegl1 libgl1-mesa-dri), or use --device cpu"
                               : "choose one that 'pliant info' lists");
}

void GLAD_API_PTR on_debug_message(GLenum, GLenum type, GLuint id, GLenum, GLsizei length, const GLchar* message, const void*) {
  const bool is_error = type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR;
  if (!is_error) return;
  std::fprintf(stderr, "OpenGL error %u (a bug in pliant): %.*s\n", id, static_cast<int>(length), message);
  std::abort();
}

/// Compilers' messages stay out: Program reports them with file and line.
void enable_debug_output() {
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_FALSE);
  glDebugMessageControl(GL_DEBUG_SOURCE_API, GL_DEBUG_TYPE_ERROR, GL_DONT_CARE, 0, nullptr, GL_TRUE);
  glDebugMessageControl(GL_DEBUG_SOURCE_API, GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR, GL_DONT_CARE, 0, nullptr, GL_TRUE);
  glDebugMessageCallback(on_debug_message, nullptr);
}

}  // namespace

struct Context::Impl {
  OpenAdapter open;
  EGLContext context = EGL_NO_CONTEXT;
  std::thread::id maker = std::this_thread::get_id();
  std::optional<WindowContext> window;  // whose context this is, if not its own
};

std::vector<Adapter> list_adapters(std::string* reason) {
  if (reason != nullptr) *reason = discovery().reason;
  std::vector<Adapter> adapters;
  for (const OpenAdapter& open : discovery().adapters) adapters.push_back(open.adapter);
  return adapters;
}

Context::Context(int index) : impl_(std::make_unique<Impl>()) {
  impl_->open = open_adapter(index);
  impl_->context = create_context(impl_->open.display);
  if (impl_->context == EGL_NO_CONTEXT || !make_current_and_load(impl_->open.display, impl_->context)) {
    throw Error(ErrorKind::device, "", fmt::format("{} gave no OpenGL context", impl_->open.adapter.renderer),
                "close other programs that use the GPU, or use --device cpu");
  }
  enable_debug_output();
}

Context::Context(WindowContext window) : impl_(std::make_unique<Impl>()) {
  impl_->window = std::move(window);
  impl_->window->make_current();
  if (gladLoadGL(impl_->window->find) == 0)
    throw Error(ErrorKind::device, "", "the window's OpenGL functions do not load", "update the graphics driver");
  impl_->open.adapter = describe_current(-1);
  enable_debug_output();
}

Context::~Context() {
  if (impl_->window) return;
  if (eglGetCurrentContext() == impl_->context) {
    eglMakeCurrent(impl_->open.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  eglDestroyContext(impl_->open.display, impl_->context);
}

const Adapter& Context::adapter() const { return impl_->open.adapter; }

void Context::make_current() {
  if (!impl_->window) {
    if (impl_->maker != std::this_thread::get_id())
      throw Error(ErrorKind::device, "", "the OpenGL context belongs to another thread",
                  "use what simulates or draws by OpenGL in the thread that made it");
    if (eglGetCurrentContext() == impl_->context) return;
    if (!make_current_and_load(impl_->open.display, impl_->context))
      throw Error(ErrorKind::device, "", fmt::format("{} has lost its OpenGL context", impl_->open.adapter.renderer), "");
    return;
  }
  impl_->window->make_current();
  gladLoadGL(impl_->window->find);
}

}  // namespace pliant::gl
