// Owning handles for the OpenGL objects pliant uses. All need a current Context.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "gl/shader_source.hpp"

namespace pliant::gl {

/// Sets what debug output and graphics debuggers call an object of this kind (GL_BUFFER, ...). Cuts off labels that are too long.
void set_label(std::uint32_t kind, std::uint32_t id, std::string_view label);

/// A buffer object with immutable storage. Throws Error (device) when the GPU has no room for it.
class Buffer {
 public:
  Buffer() = default;
  /// Zero-filled.
  Buffer(std::size_t bytes, std::string_view label);
  /// Returns a buffer that holds anything, and is made sooner.
  [[nodiscard]] static Buffer unfilled(std::size_t bytes, std::string_view label);
  ~Buffer();
  Buffer(Buffer&& other) noexcept;
  Buffer& operator=(Buffer&& other) noexcept;

  /// Throws Error (device) when the GPU has no room for a copy of the data.
  void write(std::size_t first_byte, std::span<const std::byte> data);
  /// Waits for the GPU to finish what writes this buffer. Throws Error (device) when the GPU has no room for a copy of the data.
  void read(std::size_t first_byte, std::span<std::byte> data) const;
  [[nodiscard]] std::uint32_t id() const { return id_; }
  [[nodiscard]] std::size_t size() const { return size_; }  // [bytes]

 private:
  void allocate(std::size_t bytes, std::string_view label, const std::byte* content);

  std::uint32_t id_ = 0;
  std::size_t size_ = 0;
};

/// Returns a buffer of these elements. Throws Error (device) when the GPU has no room for it.
template <class T>
[[nodiscard]] Buffer buffer_of(const std::vector<T>& elements, std::string_view label) {
  Buffer buffer = Buffer::unfilled(elements.size() * sizeof(T), label);
  buffer.write(0, std::as_bytes(std::span(elements)));
  return buffer;
}

/// Memory that the GPU copies buffers to. The processor waits once for several of them, or goes on meanwhile.
class Landing {
 public:
  Landing() = default;
  ~Landing();
  Landing(const Landing&) = delete;
  Landing& operator=(const Landing&) = delete;

  /// Bytes of a buffer, which must lie within it.
  struct Source {
    const Buffer* buffer;
    std::size_t first_byte, size;
  };

  /// Waits for the GPU, and returns these bytes, each source's behind those of the one before. They stand until the next call.
  /// Throws Error (device) when there is no room for them.
  [[nodiscard]] std::span<const std::byte> copy(std::span<const Source> sources);
  /// Does the same without waiting. The bytes stand in copied() once has_arrived().
  void begin(std::span<const Source> sources);
  /// Waits for 50 us at most.
  [[nodiscard]] bool has_arrived();
  [[nodiscard]] std::span<const std::byte> copied() const { return {mapped_, copied_}; }

 private:
  void make_room(std::size_t bytes);
  void queue(std::span<const Source> sources);
  void forget_fence();

  std::uint32_t id_ = 0;
  std::size_t size_ = 0, copied_ = 0;
  const std::byte* mapped_ = nullptr;
  void* fence_ = nullptr;  // null: nothing was begun, or it has arrived
};

/// A linked program. A shader that does not compile throws Error (device) with its true file and line.
class Program {
 public:
  Program() = default;
  static Program compute(std::string_view file, std::span<const Define> defines = {});
  static Program compute(const FlatShader& source, std::string_view label);
  static Program graphics(std::string_view vertex_file, std::string_view fragment_file, std::span<const Define> defines = {});
  ~Program();
  Program(Program&& other) noexcept;
  Program& operator=(Program&& other) noexcept;
  [[nodiscard]] std::uint32_t id() const { return id_; }

 private:
  explicit Program(std::uint32_t id) : id_(id) {}
  std::uint32_t id_ = 0;
};

}  // namespace pliant::gl
