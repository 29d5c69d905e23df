// Buffers and programs, labelled for debug output and graphics debuggers.
#include "gl/objects.hpp"

#include <fmt/format.h>
#include <glad/gl.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/expect.hpp"
#include "gl/allocation.hpp"

namespace pliant::gl {

void set_label(std::uint32_t kind, std::uint32_t id, std::string_view label) {
  GLint longest = 256;
  glGetIntegerv(GL_MAX_LABEL_LENGTH, &longest);
  glObjectLabel(kind, id, static_cast<GLsizei>(std::min(label.size(), static_cast<std::size_t>(longest) - 1)), label.data());
}

namespace {

std::string shader_log(GLuint shader) {
  GLint length = 0;
  glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  glGetShaderInfoLog(shader, length, &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  return log;
}

std::string program_log(GLuint program) {
  GLint length = 0;
  glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  glGetProgramInfoLog(program, length, &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  return log;
}

[[noreturn]] void refuse(std::string_view label, const std::string& log) {
  throw Error(ErrorKind::device, std::string(label), "the driver refuses this shader:\n" + log, "update the graphics driver");
}

/// A shader object that is deleted when the program it went into is linked.
class Shader {
 public:
  Shader(GLenum stage, const FlatShader& source, std::string_view label) : id_(glCreateShader(stage)) {
    const GLchar* text = source.text.c_str();
    glShaderSource(id_, 1, &text, nullptr);
    glCompileShader(id_);
    set_label(GL_SHADER, id_, label);
    GLint compiled = GL_FALSE;
    glGetShaderiv(id_, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return;
    const std::string log = source.explain(shader_log(id_));
    glDeleteShader(id_);
    refuse(label, log);
  }
  ~Shader() { glDeleteShader(id_); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  [[nodiscard]] GLuint id() const { return id_; }

 private:
  GLuint id_;
};

GLuint link(std::span<const Shader* const> shaders, const std::string& label) {
  const GLuint program = glCreateProgram();
  set_label(GL_PROGRAM, program, label);
  for (const Shader* shader : shaders) glAttachShader(program, shader->id());
  glLinkProgram(program);
  for (const Shader* shader : shaders) glDetachShader(program, shader->id());
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return program;
  const std::string log = program_log(program);
  glDeleteProgram(program);
  refuse(label, log);
}

void expect_within_limit(std::size_t bytes, std::string_view label) {
  GLint64 limit = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &limit);
  if (bytes > static_cast<std::size_t>(limit))
    throw Error(ErrorKind::device, "GPU memory",
                fmt::format("the buffer \"{}\" needs {} bytes, the driver allows {}", label, bytes, limit),
                "use coarser meshes or --device cpu");
}

// Gives the buffer its storage. Returns whether there is room for it.
bool has_room_for(GLuint buffer, std::size_t bytes, const std::byte* content, GLbitfield flags) {
  const Allocation allocation;
  glNamedBufferStorage(buffer, static_cast<GLsizeiptr>(bytes), content, flags);
  return !allocation.ran_out();
}

// An empty buffer still gets storage, so that it can be bound.
std::size_t stored_bytes(std::size_t bytes) { return std::max<std::size_t>(bytes, 4); }

Error no_room(std::size_t bytes, std::string_view label) {
  return {ErrorKind::device, "GPU memory", fmt::format("no room for {} bytes of \"{}\"", bytes, label),
          "use coarser meshes or --device cpu"};
}

}  // namespace

// Zeros are uploaded, because a clear is not safe. On NVIDIA (driver 580) a write of over 64 KiB overtakes a clear queued before
// it and is lost.
Buffer::Buffer(std::size_t bytes, std::string_view label) {
  expect_within_limit(bytes, label);
  allocate(bytes, label, std::vector<std::byte>(stored_bytes(bytes)).data());
}

Buffer Buffer::unfilled(std::size_t bytes, std::string_view label) {
  expect_within_limit(bytes, label);
  Buffer buffer;
  buffer.allocate(bytes, label, nullptr);
  return buffer;
}

void Buffer::allocate(std::size_t bytes, std::string_view label, const std::byte* content) {
  glCreateBuffers(1, &id_);
  if (!has_room_for(id_, stored_bytes(bytes), content, GL_DYNAMIC_STORAGE_BIT)) {
    glDeleteBuffers(1, &id_);
    id_ = 0;
    throw no_room(bytes, label);
  }
  size_ = bytes;
  set_label(GL_BUFFER, id_, label);
}

Buffer::~Buffer() {
  if (id_ != 0) glDeleteBuffers(1, &id_);
}

Buffer::Buffer(Buffer&& other) noexcept : id_(std::exchange(other.id_, 0)), size_(std::exchange(other.size_, 0)) {}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(size_, other.size_);
  return *this;
}

// Writes and reads go through a second buffer, which the GPU copies in the order of its commands. NVIDIA's driver 580 takes no
// account of indirect dispatches. After one, glGetNamedBufferSubData answers from the driver's own outdated copy of the buffer.
// glNamedBufferSubData may write before one that is still to run.
void Buffer::write(std::size_t first_byte, std::span<const std::byte> data) {
  PLIANT_EXPECT(first_byte <= size_ && data.size() <= size_ - first_byte);
  if (data.empty()) return;
  GLuint copy = 0;
  glCreateBuffers(1, &copy);
  const bool has_room = has_room_for(copy, data.size(), data.data(), GL_DYNAMIC_STORAGE_BIT);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  if (has_room) glCopyNamedBufferSubData(copy, id_, 0, static_cast<GLintptr>(first_byte), static_cast<GLsizeiptr>(data.size()));
  glDeleteBuffers(1, &copy);
  if (!has_room) throw no_room(data.size(), "data on its way");
}

void Buffer::read(std::size_t first_byte, std::span<std::byte> data) const {
  PLIANT_EXPECT(first_byte <= size_ && data.size() <= size_ - first_byte);
  if (data.empty()) return;
  const auto size = static_cast<GLsizeiptr>(data.size());
  GLuint copy = 0;
  glCreateBuffers(1, &copy);
  const bool has_room = has_room_for(copy, data.size(), nullptr, 0);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  if (has_room) {
    glCopyNamedBufferSubData(id_, copy, static_cast<GLintptr>(first_byte), 0, size);
    glGetNamedBufferSubData(copy, 0, size, data.data());
  }
  glDeleteBuffers(1, &copy);
  if (!has_room) throw no_room(data.size(), "data on its way");
}

Landing::~Landing() {
  forget_fence();
  if (id_ != 0) glDeleteBuffers(1, &id_);
}

void Landing::make_room(std::size_t bytes) {
  if (bytes <= size_) return;
  if (id_ != 0) glDeleteBuffers(1, &id_);
  glCreateBuffers(1, &id_);
  constexpr GLbitfield access = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
  size_ = 0;
  if (!has_room_for(id_, bytes, nullptr, access | GL_CLIENT_STORAGE_BIT)) throw no_room(bytes, "data on its way");
  mapped_ = static_cast<const std::byte*>(glMapNamedBufferRange(id_, 0, static_cast<GLsizeiptr>(bytes), access));
  if (mapped_ == nullptr) throw no_room(bytes, "data on its way");
  size_ = bytes;
}

void Landing::forget_fence() {
  if (fence_ != nullptr) glDeleteSync(static_cast<GLsync>(std::exchange(fence_, nullptr)));
}

void Landing::queue(std::span<const Source> sources) {
  std::size_t bytes = 0;
  for (const Source& from : sources) bytes += from.size;
  make_room(bytes);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::size_t place = 0;
  for (const Source& from : sources) {
    glCopyNamedBufferSubData(from.buffer->id(), id_, static_cast<GLintptr>(from.first_byte), static_cast<GLintptr>(place),
                             static_cast<GLsizeiptr>(from.size));
    place += from.size;
  }
  copied_ = bytes;
}

std::span<const std::byte> Landing::copy(std::span<const Source> sources) {
  queue(sources);
  glFinish();
  return copied();
}

void Landing::begin(std::span<const Source> sources) {
  forget_fence();
  queue(sources);
  fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  glFlush();
}

bool Landing::has_arrived() {
  if (fence_ == nullptr) return true;
  const GLenum found = glClientWaitSync(static_cast<GLsync>(fence_), 0, 50'000);
  if (found == GL_TIMEOUT_EXPIRED) return false;
  forget_fence();
  if (found == GL_WAIT_FAILED) throw Error(ErrorKind::device, "", "the GPU has stopped answering", "");
  return true;
}

Program Program::compute(const FlatShader& source, std::string_view label) {
  const Shader shader(GL_COMPUTE_SHADER, source, label);
  return Program(link(std::array{&shader}, std::string(label)));
}

Program Program::compute(std::string_view file, std::span<const Define> defines) {
  return compute(flatten_shader(file, defines), file);
}

Program Program::graphics(std::string_view vertex_file, std::string_view fragment_file, std::span<const Define> defines) {
  const Shader vertex(GL_VERTEX_SHADER, flatten_shader(vertex_file, defines), vertex_file);
  const Shader fragment(GL_FRAGMENT_SHADER, flatten_shader(fragment_file, defines), fragment_file);
  return Program(link(std::array{&vertex, &fragment}, std::string(vertex_file) + " + " + std::string(fragment_file)));
}

Program::~Program() {
  if (id_ != 0) glDeleteProgram(id_);
}

Program::Program(Program&& other) noexcept : id_(std::exchange(other.id_, 0)) {}

Program& Program::operator=(Program&& other) noexcept {
  std::swap(id_, other.id_);
  return *this;
}

}  // namespace pliant::gl
