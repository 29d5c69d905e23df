// Makes the CPU a device. Buffers are memory of the process, and kernels are functions over ranges of items.
#include "device/cpu/cpu_device.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <memory>
#include <new>
#include <unordered_map>
#include <utility>

#include "core/error.hpp"
#include "core/expect.hpp"
#include "core/thread_pool.hpp"
#include "device/buffer_part.hpp"
#include "device/cpu/kernel_arguments.hpp"
#include "device/cpu/spring_sums.hpp"
#include "device/device.hpp"
#include "device/kernel_pack.hpp"
#include "physics/control.glsl"

namespace pliant {
namespace {

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "CPU";
}

// Says what the bits of fp32 and fp64 sums depend on.
std::string title_of(cpu::Isa isa) {
  constexpr std::array<std::string_view, 3> titles{"baseline vectors", "AVX2", "AVX-512"};
  return std::string(titles[static_cast<std::size_t>(isa)]);
}

constexpr std::uint32_t whole_bodies = 0xffffffffu;
constexpr std::uint32_t most_vertices_alone = cpu::SpringSums<float>::most_vertices_alone;

// If there are so many shares, the small ones have a thread each, from their springs to their vertices' places. Of fewer shares
// all threads serve each.
constexpr std::size_t many_shares = 16;

constexpr bool has_own_thread(std::size_t share_count, std::uint32_t vertex_count) {
  return share_count >= many_shares && vertex_count <= most_vertices_alone;
}

// Bytes that begin as zero. Large arrays are pages of their own: they take no memory, and no time, before they are used, so a
// list may have room for the worst case. The heap would clear memory that it has lent before.
class Storage {
 public:
  explicit Storage(std::size_t bytes)
      : size_((bytes + line - 1) / line * line), bytes_(zeros(size_ + line), Release{size_ + line}) {}
  std::size_t size() const { return size_; }
  // Starts at a cache line.
  std::byte* data() const {
    const auto address = reinterpret_cast<std::uintptr_t>(bytes_.get());
    return static_cast<std::byte*>(bytes_.get()) + (line - address % line);
  }

 private:
  static constexpr std::size_t line = 64;  // [bytes]
#ifdef __SANITIZE_ADDRESS__
  static constexpr std::size_t least_mapped = std::numeric_limits<std::size_t>::max();  // it watches the heap's blocks alone
#else
  static constexpr std::size_t least_mapped = 1 << 16;  // [bytes]
#endif

  static void* zeros(std::size_t bytes) {
    void* found = bytes < least_mapped ? std::calloc(bytes, 1)
                                       : mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (found == nullptr || found == MAP_FAILED) throw std::bad_alloc();
    return found;
  }
  struct Release {
    std::size_t count;
    void operator()(void* bytes) const {
      if (count < least_mapped)
        std::free(bytes);
      else
        munmap(bytes, count);
    }
  };

  std::size_t size_;
  std::unique_ptr<void, Release> bytes_;
};

// Copies at once.
class CopyingTransfer final : public Transfer {
 public:
  CopyingTransfer(Device& device, BufferId buffer, std::vector<ByteRange> parts)
      : device_(device), buffer_(buffer), parts_(std::move(parts)) {
    std::size_t bytes = 0;
    for (const ByteRange& part : parts_) bytes += part.count;
    bytes_.resize(bytes);
  }
  void begin() override {
    std::span<std::byte> left = bytes_;
    for (const ByteRange& part : parts_) {
      device_.read(buffer_, part.first, left.first(part.count));
      left = left.subspan(part.count);
    }
  }
  bool has_arrived() override { return true; }
  std::span<const std::byte> bytes() const override { return bytes_; }

 private:
  Device& device_;
  BufferId buffer_;
  std::vector<ByteRange> parts_;
  std::vector<std::byte> bytes_;
};

class CpuDevice final : public Device {
 public:
  CpuDevice(unsigned threads, int precision) : pool_(threads), precision_(precision), kernels_(all_kernels_on_cpu(precision)) {
    for (const cpu::Isa isa : cpu::available_isas()) {
      variants_.push_back({std::string(cpu::name_of(isa)), whole_bodies});
      if (precision == 64)
        sums_64_.emplace_back(isa);
      else
        sums_32_.emplace_back(isa);
    }
    variants_.back().most_vertices = ForceVariant::any_number;
    for (const cpu::KernelEntry& entry : kernels_) signatures_.push_back(entry.signature());
    info_ = {.kind = DeviceKind::cpu, .name = cpu::device_name(), .threads = pool_.size()};
  }

  const DeviceInfo& info() const override { return info_; }
  int precision() const override { return precision_; }

  BufferId allocate(std::size_t bytes, std::string_view, Content) override {
    buffers_.emplace(next_buffer_, Storage(bytes));
    return next_buffer_++;
  }
  void enlarge(BufferId buffer, std::size_t bytes) override { buffers_.at(buffer) = Storage(bytes); }
  BufferId part_of(BufferId buffer, std::size_t first_byte, std::size_t bytes) override {
    parts_.emplace(next_buffer_, part(buffer).part(first_byte, bytes));
    return next_buffer_++;
  }
  void release(BufferId buffer) override {
    buffers_.erase(buffer);
    parts_.erase(buffer);
  }
  std::size_t size_of(BufferId buffer) const override { return part(buffer).size; }
  std::size_t allocated_bytes() const override {
    std::size_t bytes = 0;
    for (const auto& [id, buffer] : buffers_) bytes += buffer.size();
    for (const auto& sums : sums_32_) bytes += sums.scratch_bytes();
    for (const auto& sums : sums_64_) bytes += sums.scratch_bytes();
    return bytes;
  }
  void write(BufferId buffer, std::size_t first_byte, std::span<const std::byte> data) override {
    const BufferPart to = part(buffer);
    std::memcpy(storage(to.whole).data() + to.place_of(first_byte, data.size()), data.data(), data.size());
  }
  void read(BufferId buffer, std::size_t first_byte, std::span<std::byte> data) override {
    const BufferPart from = part(buffer);
    std::memcpy(data.data(), storage(from.whole).data() + from.place_of(first_byte, data.size()), data.size());
  }

  std::unique_ptr<Transfer> transfer_from(BufferId buffer, std::vector<ByteRange> parts) override {
    return std::make_unique<CopyingTransfer>(*this, buffer, std::move(parts));
  }

  KernelId kernel(std::string_view name) override {
    for (std::size_t k = 0; k < kernels_.size(); ++k)
      if (kernels_[k].name == name) return static_cast<KernelId>(k);
    throw Error(ErrorKind::device, std::string(name), "no such kernel on the CPU", "");
  }

  KernelId group_kernel(std::string_view name, std::uint32_t) override { return kernel(name); }
  KernelId round_kernel(std::string_view name) override { return kernel(name); }
  std::uint32_t groups_at_once(KernelId) override { return 1; }
  KernelId force_kernel(std::string_view name, std::size_t variant, ForceSpan span) override {
    PLIANT_EXPECT(span == ForceSpan::stage);
    return kernel(name) + static_cast<KernelId>(variant * kernels_.size());
  }
  const KernelSignature& signature(KernelId kernel) const override { return signatures_[kernel % kernels_.size()]; }
  std::span<const ForceVariant> force_variants() const override { return variants_; }
  const ForceVariant& variant_for_given_sums() const override { return for_given_sums_; }
  std::uint32_t shares_at_once() const override { return 0; }

  double strain_bias() override { return 0; }

  void run(std::span<const Pass> passes) override {
    for (const Pass& pass : passes)
      if (pass.host_work != nullptr)
        pass.host_work->run();
      else
        run(pass.call, pass.item_count);
  }
  void run(const KernelCall& call, std::uint32_t item_count) {
    std::array<void*, max_arrays + max_constants> buffers{};
    PLIANT_EXPECT(call.buffers.size() <= buffers.size());
    for (std::size_t k = 0; k < call.buffers.size(); ++k) buffers[k] = bytes_of(call.buffers[k]);
    const cpu::KernelArguments arguments{
        .buffers = buffers.data(), .parameters = call.parameters.data(), .works_alone = pool_.size() == 1};
    const cpu::KernelEntry& entry = kernels_[call.kernel % kernels_.size()];
    if (entry.rounds.run != nullptr) {
      run_rounds(entry, arguments);
      return;
    }
    if (entry.function == nullptr) {
      run_forces(entry.force, call.kernel / kernels_.size(), arguments, item_count);
      return;
    }
    pool_.share(item_count, grain_of(entry, item_count), [&](ThreadPool::Ranges& items) { entry.function(arguments, items); });
  }
  std::uint32_t parallel_items(std::uint32_t) const override { return 256; }
  std::uint32_t items_of_lists(std::uint32_t) const override { return 256; }
  void finish() override {}
  void mark_time() override {
    times_.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count());
  }
  std::vector<double> take_times() override { return std::exchange(times_, {}); }

 private:
  // Vertices `first` to `end` - 1 of a share.
  struct Range {
    std::uint32_t share, first, end;
  };

  // Threads wait for each other's takes, and so take more at a time where there are many items.
  std::uint32_t grain_between(std::uint32_t least, std::uint32_t most, std::uint32_t items) const {
    constexpr std::uint32_t ranges_of_a_thread = 8;  // where there are enough, so that all end at about the same time
    return std::clamp(items / (ranges_of_a_thread * pool_.size()), least, most);
  }

  // One thread takes all items at once.
  std::uint32_t grain_of(const cpu::KernelEntry& entry, std::uint32_t items) const {
    if (pool_.size() == 1) return std::numeric_limits<std::uint32_t>::max();
    return entry.grain == 1 ? 1 : grain_between(entry.grain, 8 * entry.grain, items);
  }

  void run_rounds(const cpu::KernelEntry& entry, const cpu::KernelArguments& arguments) {
    const std::uint32_t items = entry.rounds.items(arguments), most = entry.rounds.most(arguments);
    if (items == 0) return;
    for (std::uint32_t round = 0; round < most; ++round) {
      pool_.share(items, grain_of(entry, items), [&](ThreadPool::Ranges& part) { entry.rounds.run(arguments, round, part); });
      if (!entry.rounds.goes_on(arguments, round)) return;
    }
  }

  void run_forces(const cpu::ForceFunctions& force, std::size_t variant, const cpu::KernelArguments& arguments,
                  std::uint32_t share_count) {
    tasks_.clear();
    if (share_count < many_shares)
      for (std::uint32_t share = 0; share < share_count; ++share) tasks_.push_back(force.task(arguments, share));
    else
      serve_small_shares(force, variant, arguments, share_count);
    std::size_t vertex_count = 0;
    for (const cpu::ShareTask& task : tasks_) vertex_count += task.runs ? task.vertex_count : 0;
    if (vertex_count == 0) return;
    sums_.assign(vertex_count, glm::dvec3(0.0));
    if (variant == variants_.size())
      take_given_sums();
    else if (variant == 0)
      sum_plainly();
    else if (precision_ == 64)
      sum_in_vectors(sums_64_[variant - 1]);
    else
      sum_in_vectors(sums_32_[variant - 1]);
    finish_forces(force, arguments);
  }

  // Leaves the tasks of the others in `tasks_`.
  void serve_small_shares(const cpu::ForceFunctions& force, std::size_t variant, const cpu::KernelArguments& arguments,
                          std::uint32_t share_count) {
    tasks_.resize(share_count);
    pool_.for_ranges(share_count, grain_between(1, 16, share_count), [&](std::uint32_t first, std::uint32_t end) {
      for (std::uint32_t share = first; share < end; ++share) {
        const cpu::ShareTask task = force.task(arguments, share);
        const bool is_small = has_own_thread(share_count, task.body_vertices);
        if (is_small && task.runs) serve_alone(force, variant, arguments, share, task);
        tasks_[share] = is_small ? cpu::ShareTask() : task;
      }
    });
  }

  // Makes all of a force kernel for one share on the calling thread. What one part leaves in the caches, the next one finds
  // there.
  void serve_alone(const cpu::ForceFunctions& force, std::size_t variant, const cpu::KernelArguments& arguments,
                   std::uint32_t share, const cpu::ShareTask& task) const {
    std::array<glm::dvec3, most_vertices_alone> sums;
    if (!task.deformed)
      std::fill_n(sums.begin(), task.vertex_count, glm::dvec3(0.0));
    else if (variant == variants_.size())
      store_given_sums(task, sums.data());
    else if (variant == 0)
      plain_sum()(task, sums.data(), 0, task.vertex_count);
    else if (precision_ == 64)
      sums_64_[variant - 1].sum_alone(spring_body<double>(task, sums.data()));
    else
      sums_32_[variant - 1].sum_alone(spring_body<float>(task, sums.data()));
    for (std::uint32_t first = 0; first < task.vertex_count; first += cpu::longest_range)
      force.finish(arguments, share, sums.data(), first, std::min(first + cpu::longest_range, task.vertex_count));
  }

  // Calls `visit` with every share that runs, and its sums.
  template <class F>
  void for_shares(F&& visit) {
    glm::dvec3* sums = sums_.data();
    for (std::uint32_t share = 0; share < tasks_.size(); ++share) {
      if (!tasks_[share].runs) continue;
      visit(share, tasks_[share], sums);
      sums += tasks_[share].vertex_count;
    }
  }

  static void store_given_sums(const cpu::ShareTask& task, glm::dvec3* sums) {
    const double* given = task.given_sums + std::size_t{3} * task.first_vertex;
    for (std::uint32_t v = 0; v < task.vertex_count; ++v, given += 3) sums[v] = {given[0], given[1], given[2]};
  }

  void take_given_sums() {
    for_shares([](std::uint32_t, const cpu::ShareTask& task, glm::dvec3* sums) {
      if (task.deformed) store_given_sums(task, sums);
    });
  }

  cpu::PlainSum plain_sum() const { return precision_ == 64 ? cpu::sum_plainly_64 : cpu::sum_plainly_32; }

  void sum_plainly() {
    for_shares([&](std::uint32_t, const cpu::ShareTask& task, glm::dvec3* sums) {
      if (!task.deformed) return;
      pool_.for_ranges(task.vertex_count, 16,
                       [&](std::uint32_t first, std::uint32_t end) { plain_sum()(task, sums, first, end); });
    });
  }

  template <class Real>
  static cpu::SpringBody<Real> spring_body(const cpu::ShareTask& task, glm::dvec3* sums) {
    return {static_cast<const glm::vec<4, Real>*>(task.positions),
            static_cast<const glm::vec<4, Real>*>(task.displacements),
            task.body_vertices,
            task.first_in_body,
            task.vertex_count,
            sums};
  }

  template <class Real>
  void sum_in_vectors(cpu::SpringSums<Real>& spring_sums) {
    std::vector<cpu::SpringBody<Real>> bodies;
    for_shares([&](std::uint32_t, const cpu::ShareTask& task, glm::dvec3* sums) {
      if (task.deformed) bodies.push_back(spring_body<Real>(task, sums));
    });
    spring_sums.sum(pool_, bodies);
  }

  void finish_forces(const cpu::ForceFunctions& force, const cpu::KernelArguments& arguments) {
    ranges_.clear();
    share_sums_.assign(tasks_.size(), nullptr);
    for_shares([&](std::uint32_t share, const cpu::ShareTask& task, const glm::dvec3* sums) {
      share_sums_[share] = sums;
      for (std::uint32_t first = 0; first < task.vertex_count; first += cpu::longest_range)
        ranges_.push_back({share, first, std::min(first + cpu::longest_range, task.vertex_count)});
    });
    pool_.for_ranges(static_cast<std::uint32_t>(ranges_.size()), 2, [&](std::uint32_t first, std::uint32_t end) {
      for (; first < end; ++first) {
        const Range& range = ranges_[first];
        force.finish(arguments, range.share, share_sums_[range.share], range.first, range.end);
      }
    });
  }

  const Storage& storage(BufferId buffer) const {
    const auto found = buffers_.find(buffer);
    PLIANT_EXPECT(found != buffers_.end());
    return found->second;
  }
  BufferPart part(BufferId buffer) const {
    const auto found = parts_.find(buffer);
    return found != parts_.end() ? found->second : BufferPart{buffer, 0, storage(buffer).size()};
  }
  std::byte* bytes_of(BufferId buffer) const {
    const BufferPart at = part(buffer);
    return storage(at.whole).data() + at.first_byte;
  }

  ThreadPool pool_;
  int precision_;
  std::vector<cpu::KernelEntry> kernels_;
  std::vector<KernelSignature> signatures_;
  DeviceInfo info_;
  std::vector<ForceVariant> variants_{{"plain", whole_bodies}};
  ForceVariant for_given_sums_{"given sums", whole_bodies};
  std::vector<cpu::SpringSums<float>> sums_32_;  // one per instruction set, in this device's precision only
  std::vector<cpu::SpringSums<double>> sums_64_;
  std::vector<cpu::ShareTask> tasks_;  // of the shares of the force kernel that runs
  std::vector<glm::dvec3> sums_;       // of all their vertices
  std::vector<const glm::dvec3*> share_sums_;
  std::vector<Range> ranges_;
  std::vector<double> times_;
  std::unordered_map<BufferId, Storage> buffers_;
  std::unordered_map<BufferId, BufferPart> parts_;
  BufferId next_buffer_ = 1;
};

}  // namespace

std::string cpu::device_name() { return processor_name() + ", " + title_of(available_isas().back()); }

std::size_t cpu::spring_scratch_bytes(std::span<const std::uint32_t> vertex_counts, int precision) {
  std::size_t bytes = 0;
  for (const std::uint32_t count : vertex_counts)
    if (!has_own_thread(vertex_counts.size(), count))
      bytes += precision == 64 ? SpringSums<double>::scratch_bytes_of(count) : SpringSums<float>::scratch_bytes_of(count);
  return bytes;
}

std::unique_ptr<Device> make_cpu_device(unsigned threads, int precision) {
  PLIANT_EXPECT(precision == 32 || precision == 64);
  return std::make_unique<CpuDevice>(threads, precision);
}

}  // namespace pliant
