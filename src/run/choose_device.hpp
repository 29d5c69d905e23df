// Chooses the device of a run.
#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "device/device.hpp"
#include "gl/context.hpp"
#include "model/model.hpp"
#include "ranks/ranks.hpp"

namespace pliant {

enum class DeviceWish { automatic, cpu, gpu };

struct DeviceChoice {
  std::optional<DeviceWish> wish;  // empty: automatic, or what a resumed run had before
  std::optional<int> gpu_index;    // of gl::list_adapters()
  std::optional<int> precision;    // of the forces [bits]; empty: 32
  unsigned threads = 0;            // 0: one a processor
};

[[nodiscard]] bool has_hardware_gpu();

/// Throws Error (command_line) if the choice contradicts itself.
void expect_consistent(const DeviceChoice& choice);

/// Returns the choice of one of several ranks: of GPUs a rank takes one in turn, and of processors its part, unless the choice
/// names them.
[[nodiscard]] DeviceChoice choice_of_rank(DeviceChoice choice, const Ranks& ranks);

/// Returns how many threads a rank has, of those on a machine. MPI has allowed it so many processors of those that are online.
[[nodiscard]] unsigned threads_of_rank(unsigned allowed, unsigned online, std::size_t ranks_here);

/// Returns warnings: ranks on this machine have to share GPUs, or all do the same work.
[[nodiscard]] std::vector<std::string> told_of_ranks(const DeviceChoice& choice, const Ranks& ranks, const Model& model);

/// Makes the device. The automatic choice is a hardware GPU if there is one and the precision is 32, else the CPU. Software
/// OpenGL is used only if a GPU is asked for. Throws Error: command_line if the choice contradicts itself, device if there is no
/// such device.
[[nodiscard]] std::unique_ptr<Device> choose_device(const DeviceChoice& choice);
/// Does the same, but the only GPU is the window's.
[[nodiscard]] std::unique_ptr<Device> choose_device(const DeviceChoice& choice, gl::Context& window);

}  // namespace pliant
