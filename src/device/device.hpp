// A device holds arrays and runs kernels over items. A kernel is one file in shaders/compute/kernels, the same on every device.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "device/force_variant.hpp"

namespace pliant {

class Ranks;

struct ByteRange {
  std::size_t first = 0, count = 0;
};

using BufferId = std::uint32_t;  // 0: none
using KernelId = std::uint32_t;
using Parameter = std::variant<std::uint32_t, double>;

inline constexpr std::size_t part_alignment = 256;  // of the first byte of a buffer's part [bytes]. OpenGL asks for no more

/// What a new buffer holds. One that holds anything is made sooner.
enum class Content { zeros, anything };

enum class ArrayUse { read, write, constants };

/// What a kernel declares, in its own order. A call gives buffers and parameters in the same order.
struct KernelSignature {
  struct Array {
    std::string name;   // in the kernel: the array's own, or that of a view
    std::string array;  // of physics/arrays.glsl
    ArrayUse use = ArrayUse::read;
    std::string view = {};  // the type of elements that READ_AS or WRITE_AS asks for. Empty: the list's
  };
  struct Number {
    std::string name;
    bool is_double = false;  // else uint
  };
  std::vector<Array> arrays;
  std::vector<Number> parameters;
};

/// How many arrays a kernel may have beside those of constants. OpenGL guarantees 8 storage blocks. NVIDIA, AMD, Intel and
/// llvmpipe have these and more.
inline constexpr std::size_t max_arrays = 16, max_constants = 1;

/// A kernel with its buffers and parameters, in the order of its signature.
struct KernelCall {
  KernelId kernel = 0;
  std::vector<BufferId> buffers;
  std::vector<Parameter> parameters;
};

/// Work of the processor between kernels, such as sending numbers to another process.
class HostWork {
 public:
  virtual ~HostWork() = default;
  /// Is called when all passes before it have been queued. Reading from the device waits for them.
  virtual void run() = 0;
};

/// Parts of a buffer on their way to the processor, while the device goes on. It can be used again and again.
class Transfer {
 public:
  virtual ~Transfer() = default;
  /// Queues the copying, behind the kernels so far.
  virtual void begin() = 0;
  /// Waits for a moment at most. Returns whether all has arrived that was begun last.
  [[nodiscard]] virtual bool has_arrived() = 0;
  /// Returns what has arrived, each part behind the one before. It stands until begin().
  [[nodiscard]] virtual std::span<const std::byte> bytes() const = 0;
};

/// One dispatch, or work of the processor, recorded once and run many times.
struct Pass {
  std::string_view name;  // the kernel's
  KernelCall call;
  std::uint32_t item_count = 0;
  std::shared_ptr<HostWork> host_work = {};  // runs instead of a kernel; null: a kernel runs
  bool beside_next = false;  // the next pass need not wait for this one: neither writes what the other uses, but by atomics
};

/// What one dispatch of a force kernel makes.
enum class ForceSpan { stage, step, quiet_steps, quiet_steps_of_impulses };

enum class DeviceKind { cpu, gpu };
/// Returns "cpu" or "gpu".
[[nodiscard]] constexpr std::string_view name_of(DeviceKind kind) { return kind == DeviceKind::cpu ? "cpu" : "gpu"; }

struct DeviceInfo {
  DeviceKind kind = DeviceKind::cpu;
  std::string name;               // model, and what its bits depend on
  unsigned threads = 1;           // of the CPU that run kernels
  std::uint64_t free_memory = 0;  // of a GPU, when the device was made [bytes]. 0 if nobody tells
};

/// Passes run one after another: each starts after the one before has finished, unless that one has `beside_next`. run() may
/// return earlier. One thread at a time may use a device.
class Device {
 public:
  virtual ~Device() = default;
  [[nodiscard]] virtual const DeviceInfo& info() const = 0;
  /// Returns the bits of the forces' `real`: 32 or 64. Anything else is the same in both.
  [[nodiscard]] virtual int precision() const = 0;

  /// Throws Error (device) if a GPU has no room, and std::bad_alloc if the processor has none.
  [[nodiscard]] virtual BufferId allocate(std::size_t bytes, std::string_view label, Content content) = 0;
  /// Gives a buffer more bytes. It may hold anything then. Throws as allocate() does, and the buffer keeps its size.
  virtual void enlarge(BufferId buffer, std::size_t bytes) = 0;
  /// Returns some bytes of a buffer, or of such a part, as a buffer of its own. The whole buffer must outlive it.
  [[nodiscard]] virtual BufferId part_of(BufferId buffer, std::size_t first_byte, std::size_t bytes) = 0;
  virtual void release(BufferId buffer) = 0;
  /// Returns at least what was asked for [bytes].
  [[nodiscard]] virtual std::size_t size_of(BufferId buffer) const = 0;
  /// Returns the size of all buffers and of the device's own scratch memory [bytes].
  [[nodiscard]] virtual std::size_t allocated_bytes() const = 0;
  /// The program ends if what is written or read lies beyond the buffer or part.
  virtual void write(BufferId buffer, std::size_t first_byte, std::span<const std::byte> data) = 0;
  /// Waits for the kernels before it.
  virtual void read(BufferId buffer, std::size_t first_byte, std::span<std::byte> data) = 0;
  /// Returns a way for these parts, which must lie within the buffer. Buffer and device must outlive it.
  [[nodiscard]] virtual std::unique_ptr<Transfer> transfer_from(BufferId buffer, std::vector<ByteRange> parts) = 0;
  /// Says which buffers will be read next. A device that makes readers wait may wait once for all of them, if nothing runs or is
  /// written in between. What was read ahead before is forgotten.
  virtual void read_ahead(std::span<const BufferId> /*buffers*/) {}

  /// Returns the kernel in the file kernels/NAME.glsl, whose function has the same name. Throws Error (device) if it does not
  /// build.
  [[nodiscard]] virtual KernelId kernel(std::string_view name) = 0;
  /// Returns a kernel whose items are served by a group of so many threads each (shaders/compute/groups.comp). On a CPU that is
  /// one thread. On a GPU it is a power of two, from 32 to 1024.
  [[nodiscard]] virtual KernelId group_kernel(std::string_view name, std::uint32_t threads) = 0;
  /// Returns a kernel that goes in rounds (shaders/compute/rounds.comp). Its items are work groups that wait for each other: at
  /// most groups_at_once() of them.
  [[nodiscard]] virtual KernelId round_kernel(std::string_view name) = 0;
  /// Returns how many work groups of such a kernel are known to run at once, at least 1 and at most shares_at_once(). That
  /// depends on the memory that it takes. So a GPU lets groups wait for each other when it is first asked.
  [[nodiscard]] virtual std::uint32_t groups_at_once(KernelId round_kernel) = 0;
  /// Returns a variant of a kernel that sums springs (kernels/parts/force_kernel.glsl). It is one of force_variants(), or behind
  /// them variant_for_given_sums(). Its items are shares of bodies. If it
  /// runs every stage of a step (kernels/parts/stages.glsl), it has at most shares_at_once() items, unless each body is one
  /// share. If it runs quiet steps (kernels/parts/quiet_steps.glsl), its items are work groups, at most quiet_groups of them.
  /// These take shares of bodies that move in turn if each body is one share, and else one each. If a device with
  /// shares_at_once() does not run all of them at once, they make no step.
  [[nodiscard]] virtual KernelId force_kernel(std::string_view name, std::size_t variant, ForceSpan span = ForceSpan::stage) = 0;
  [[nodiscard]] virtual const KernelSignature& signature(KernelId kernel) const = 0;
  /// Returns how many items of a force kernel run side by side, so that they may wait for each other. It is 0 if that is not
  /// known. If they do not, they wait some seconds, and the simulation then throws.
  [[nodiscard]] virtual std::uint32_t shares_at_once() const = 0;
  [[nodiscard]] virtual std::span<const ForceVariant> force_variants() const = 0;
  /// Returns the variant whose kernels sum no springs. Passes before them set `spring_sum`.
  [[nodiscard]] virtual const ForceVariant& variant_for_given_sums() const = 0;
  /// Returns the relative error by which springs' strains come out too large, on average over springs.
  [[nodiscard]] virtual double strain_bias() = 0;
  virtual void run(std::span<const Pass> passes) = 0;
  /// Lets simulations that are made on it from then on be made together with other processes. These ranks must outlive them.
  /// Null: they are alone.
  void join(Ranks* ranks) { ranks_ = ranks; }
  [[nodiscard]] Ranks* ranks() const { return ranks_; }
  /// Returns how many items keep the device busy in a scene of so many bodies. That is how finely a search is best cut.
  [[nodiscard]] virtual std::uint32_t parallel_items(std::uint32_t bodies) const = 0;
  /// Returns how many items best share a list in strides, if only the device knows the list's length.
  [[nodiscard]] virtual std::uint32_t items_of_lists(std::uint32_t bodies) const = 0;
  /// Waits until everything has run.
  virtual void finish() = 0;

  /// Queues a reading of the device's own clock, taken when all kernels before it have finished.
  virtual void mark_time() = 0;
  /// Returns the marked times since the last call [s], from any origin. Waits for them.
  [[nodiscard]] virtual std::vector<double> take_times() = 0;

 private:
  Ranks* ranks_ = nullptr;
};

/// An owned array of `count` elements on a device, which must outlive it.
template <class T>
class DeviceArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  DeviceArray() = default;
  DeviceArray(Device& device, std::size_t count, std::string_view label, Content content = Content::zeros)
      : device_(&device), count_(count), id_(device.allocate(std::max<std::size_t>(count, 1) * sizeof(T), label, content)) {}
  /// Takes over a buffer that has room for the elements.
  DeviceArray(Device& device, BufferId buffer, std::size_t count) : device_(&device), count_(count), id_(buffer) {}
  DeviceArray(Device& device, std::span<const T> values, std::string_view label)
      : DeviceArray(device, values.size(), label, Content::anything) {
    upload(values);
  }
  ~DeviceArray() {
    if (device_ != nullptr) device_->release(id_);
  }
  DeviceArray(DeviceArray&& other) noexcept { swap(other); }
  DeviceArray& operator=(DeviceArray&& other) noexcept {
    swap(other);
    return *this;
  }

  void upload(std::span<const T> values, std::size_t first = 0) {
    if (!values.empty()) device_->write(id_, first * sizeof(T), std::as_bytes(values));
  }
  void download(std::span<T> values, std::size_t first = 0) const {
    if (!values.empty()) device_->read(id_, first * sizeof(T), std::as_writable_bytes(values));
  }
  [[nodiscard]] std::vector<T> download(std::size_t first, std::size_t count) const {
    std::vector<T> values(count);
    download(values, first);
    return values;
  }
  [[nodiscard]] std::vector<T> download() const { return download(0, count_); }
  [[nodiscard]] BufferId id() const { return id_; }
  [[nodiscard]] std::size_t size() const { return count_; }

 private:
  void swap(DeviceArray& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(count_, other.count_);
    std::swap(id_, other.id_);
  }

  Device* device_ = nullptr;
  std::size_t count_ = 0;
  BufferId id_ = 0;
};

/// Makes the CPU a device. `threads` 0 asks for one per processor. `precision` is 32 or 64. Throws Error (device) if the system
/// gives fewer threads.
[[nodiscard]] std::unique_ptr<Device> make_cpu_device(unsigned threads, int precision);

/// Opens the `index`-th adapter of gl::list_adapters() and keeps its context current on this thread. Throws Error (device).
[[nodiscard]] std::unique_ptr<Device> make_gpu_device(int index);

}  // namespace pliant
