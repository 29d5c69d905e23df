// A device whose memory can run out.
#pragma once
#include <limits>
#include <memory>
#include <new>
#include <utility>

#include "core/error.hpp"
#include "device/device.hpp"

namespace pliant::test {

/// Does what another device does, and refuses large buffers when it is told to.
class FullDevice : public Device {
 public:
  explicit FullDevice(std::unique_ptr<Device> inner) : inner_(std::move(inner)) {}
  /// From here on no buffer can be larger. Asking for one throws what a device of that kind throws.
  void refuse_beyond(std::size_t bytes, DeviceKind kind = DeviceKind::gpu) {
    most_bytes_ = bytes;
    kind_ = kind;
  }

  const DeviceInfo& info() const override { return inner_->info(); }
  int precision() const override { return inner_->precision(); }
  BufferId allocate(std::size_t bytes, std::string_view label, Content content) override {
    expect_room(bytes);
    return inner_->allocate(bytes, label, content);
  }
  void enlarge(BufferId buffer, std::size_t bytes) override {
    expect_room(bytes);
    inner_->enlarge(buffer, bytes);
  }
  BufferId part_of(BufferId buffer, std::size_t first, std::size_t bytes) override {
    return inner_->part_of(buffer, first, bytes);
  }
  void release(BufferId buffer) override { inner_->release(buffer); }
  std::size_t size_of(BufferId buffer) const override { return inner_->size_of(buffer); }
  std::size_t allocated_bytes() const override { return inner_->allocated_bytes(); }
  void write(BufferId to, std::size_t first, std::span<const std::byte> data) override { inner_->write(to, first, data); }
  void read(BufferId from, std::size_t first, std::span<std::byte> data) override { inner_->read(from, first, data); }
  std::unique_ptr<Transfer> transfer_from(BufferId from, std::vector<ByteRange> parts) override {
    return inner_->transfer_from(from, std::move(parts));
  }
  KernelId kernel(std::string_view name) override { return inner_->kernel(name); }
  KernelId group_kernel(std::string_view name, std::uint32_t threads) override { return inner_->group_kernel(name, threads); }
  KernelId round_kernel(std::string_view name) override { return inner_->round_kernel(name); }
  std::uint32_t groups_at_once(KernelId kernel) override { return inner_->groups_at_once(kernel); }
  KernelId force_kernel(std::string_view name, std::size_t variant, ForceSpan span) override {
    return inner_->force_kernel(name, variant, span);
  }
  const KernelSignature& signature(KernelId kernel) const override { return inner_->signature(kernel); }
  std::uint32_t shares_at_once() const override { return inner_->shares_at_once(); }
  std::span<const ForceVariant> force_variants() const override { return inner_->force_variants(); }
  const ForceVariant& variant_for_given_sums() const override { return inner_->variant_for_given_sums(); }
  double strain_bias() override { return inner_->strain_bias(); }
  void run(std::span<const Pass> passes) override { inner_->run(passes); }
  std::uint32_t parallel_items(std::uint32_t bodies) const override { return inner_->parallel_items(bodies); }
  std::uint32_t items_of_lists(std::uint32_t bodies) const override { return inner_->items_of_lists(bodies); }
  void finish() override { inner_->finish(); }
  void mark_time() override { inner_->mark_time(); }
  std::vector<double> take_times() override { return inner_->take_times(); }

 private:
  void expect_room(std::size_t bytes) const {
    if (bytes <= most_bytes_) return;
    if (kind_ == DeviceKind::cpu) throw std::bad_alloc();
    throw Error(ErrorKind::device, "", "no room is left", "");
  }

  std::unique_ptr<Device> inner_;
  std::size_t most_bytes_ = std::numeric_limits<std::size_t>::max();
  DeviceKind kind_ = DeviceKind::gpu;
};

}  // namespace pliant::test
