#include "run/choose_device.hpp"

#include "core/error.hpp"
#include "device/gpu/gpu_device.hpp"

namespace pliant {
namespace {

// Returns whether an automatic choice may take a GPU.
bool may_be_gpu(const DeviceChoice& choice) {
  return choice.wish.value_or(DeviceWish::automatic) == DeviceWish::automatic && choice.precision.value_or(32) == 32;
}

}  // namespace

void expect_consistent(const DeviceChoice& choice) {
  const bool gpu = choice.wish == DeviceWish::gpu || choice.gpu_index;
  if (gpu && choice.wish == DeviceWish::cpu)
    throw Error(ErrorKind::command_line, "--gpu", "does not go with --device cpu", "leave one of them out");
  if (gpu && choice.precision == 64)
    throw Error(ErrorKind::command_line, "--precision 64", "fp64 forces run on the CPU alone",
                "add --device cpu or leave --precision out");
}

bool has_hardware_gpu() {
  const auto adapters = gl::list_adapters();
  return !adapters.empty() && !adapters.front().is_software;
}

std::unique_ptr<Device> choose_device(const DeviceChoice& choice) {
  expect_consistent(choice);
  const bool asked = choice.wish == DeviceWish::gpu || choice.gpu_index;
  if (asked || (may_be_gpu(choice) && has_hardware_gpu())) return make_gpu_device(choice.gpu_index.value_or(0));
  return make_cpu_device(choice.threads, choice.precision.value_or(32));
}

std::unique_ptr<Device> choose_device(const DeviceChoice& choice, gl::Context& window) {
  expect_consistent(choice);
  if ((may_be_gpu(choice) && !window.adapter().is_software) || choice.wish == DeviceWish::gpu) return make_gpu_device(window);
  return make_cpu_device(choice.threads, choice.precision.value_or(32));
}

}  // namespace pliant
