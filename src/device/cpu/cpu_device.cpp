// The CPU as a device: buffers are heap memory, kernels are functions over ranges of items.
#include <cstring>
#include <fstream>
#include <memory>
#include <unordered_map>

#include "core/error.hpp"
#include "core/expect.hpp"
#include "core/thread_pool.hpp"
#include "device/cpu/kernel_arguments.hpp"
#include "device/device.hpp"
#include "physics/control.glsl"

namespace pliant {
namespace {

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "CPU";
}

class CpuDevice final : public Device {
 public:
  CpuDevice(unsigned threads, int precision)
      : pool_(threads), precision_(precision), kernels_(precision == 64 ? cpu::kernels_64() : cpu::kernels_32()) {
    info_ = {.kind = "cpu", .name = processor_name(), .threads = pool_.size()};
  }

  const DeviceInfo& info() const override { return info_; }
  int precision() const override { return precision_; }

  BufferId allocate(std::size_t bytes, std::string_view) override {
    buffers_.emplace(next_buffer_, Storage((bytes + sizeof(Line) - 1) / sizeof(Line)));
    return next_buffer_++;
  }
  void release(BufferId buffer) override { buffers_.erase(buffer); }
  std::size_t size_of(BufferId buffer) const override { return buffers_.at(buffer).size() * sizeof(Line); }
  std::size_t allocated_bytes() const override {
    std::size_t bytes = 0;
    for (const auto& [id, buffer] : buffers_) bytes += buffer.size() * sizeof(Line);
    return bytes;
  }
  void write(BufferId buffer, std::size_t first_byte, std::span<const std::byte> data) override {
    std::memcpy(bytes_of(buffer) + first_byte, data.data(), data.size());
  }
  void read(BufferId buffer, std::size_t first_byte, std::span<std::byte> data) override {
    std::memcpy(data.data(), bytes_of(buffer) + first_byte, data.size());
  }

  KernelId kernel(std::string_view name) override {
    for (std::size_t k = 0; k < kernels_.size(); ++k)
      if (kernels_[k].name == name) return static_cast<KernelId>(k);
    throw Error(ErrorKind::device, std::string(name), "no such kernel on the CPU", "");
  }

  void run(const KernelCall& call, std::uint32_t item_count) override {
    cpu::KernelArguments arguments;
    arguments.parameters = &call.parameters;
    for (std::size_t slot = 0; slot < max_buffers; ++slot)
      if (call.buffers[slot] != 0) arguments.buffers[slot] = bytes_of(call.buffers[slot]);
    const cpu::KernelFunction function = kernels_[call.kernel].function;
    pool_.for_ranges(item_count, 16, [&](std::uint32_t first, std::uint32_t end) { function(arguments, first, end); });
  }
  void run_indirect(const KernelCall& call, BufferId group_counts, std::size_t first_byte) override {
    std::uint32_t groups = 0;
    read(group_counts, first_byte, std::as_writable_bytes(std::span(&groups, 1)));
    run(call, groups * physics::group_size);
  }
  void finish() override {}

 private:
  struct alignas(64) Line {
    std::byte bytes[64];
  };
  using Storage = std::vector<Line>;

  std::byte* bytes_of(BufferId buffer) {
    const auto found = buffers_.find(buffer);
    PLIANT_EXPECT(found != buffers_.end());
    return found->second.data()->bytes;
  }

  ThreadPool pool_;
  int precision_;
  std::span<const cpu::KernelEntry> kernels_;
  DeviceInfo info_;
  std::unordered_map<BufferId, Storage> buffers_;
  BufferId next_buffer_ = 1;
};

}  // namespace

std::unique_ptr<Device> make_cpu_device(unsigned threads, int precision) {
  PLIANT_EXPECT(precision == 32 || precision == 64);
  return std::make_unique<CpuDevice>(threads, precision);
}

}  // namespace pliant
