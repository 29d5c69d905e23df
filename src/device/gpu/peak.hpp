// Does as many fp32 multiply-adds as a GPU can. Sums of springs are measured against that.
#pragma once
#include <cstdint>
#include <memory>

#include "device/device.hpp"

namespace pliant::gpu {

/// Runs chains of multiply-adds on a GPU device, which must outlive this. Expects that context_of(device) is not null.
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
