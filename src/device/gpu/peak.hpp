// The fp32 multiply-adds that a GPU does at best: what sums of springs are measured against.
#pragma once
#include <cstdint>
#include <memory>

#include "device/device.hpp"

namespace pliant::gpu {

/// Chains of multiply-adds on a GPU device (context_of(device) is not null), which must outlive this.
class Peak {
 public:
  explicit Peak(Device& device);
  ~Peak();

  /// Queues one dispatch of multiply_adds() multiply-adds.
  void run();
  [[nodiscard]] std::uint64_t multiply_adds() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pliant::gpu
