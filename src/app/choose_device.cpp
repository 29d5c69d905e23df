#include "app/choose_device.hpp"

#include "core/error.hpp"
#include "gl/context.hpp"

namespace pliant::app {
namespace {

void expect_consistent(const DeviceChoice& choice) {
  const bool gpu = choice.kind == DeviceKind::gpu || choice.gpu_index;
  if (gpu && choice.kind == DeviceKind::cpu)
    throw Error(ErrorKind::command_line, "--gpu", "does not go with --device cpu", "leave one of them out");
  if (gpu && choice.precision == 64)
    throw Error(ErrorKind::command_line, "--precision 64", "fp64 forces run on the CPU alone",
                "add --device cpu or leave --precision out");
}

int adapter_index(const DeviceChoice& choice) {
  std::string reason;
  const auto adapters = gl::list_adapters(&reason);
  if (adapters.empty())
    throw Error(ErrorKind::device, "--device gpu", "no OpenGL 4.5 device: " + reason,
                "install a graphics driver (Debian: libegl1 and libgl1-mesa-dri), or use --device cpu");
  const int index = choice.gpu_index.value_or(0);
  if (index < 0 || index >= static_cast<int>(adapters.size()))
    throw Error(ErrorKind::device, "--gpu " + std::to_string(index), "there is no such GPU", "`pliant info` lists them");
  return index;
}

bool has_hardware_gpu() {
  const auto adapters = gl::list_adapters();
  return !adapters.empty() && !adapters.front().is_software;
}

}  // namespace

std::unique_ptr<Device> choose_device(const DeviceChoice& choice) {
  expect_consistent(choice);
  const bool asked = choice.kind == DeviceKind::gpu || choice.gpu_index;
  const bool found = choice.kind == DeviceKind::automatic && choice.precision == 32 && !asked && has_hardware_gpu();
  if (asked || found) return make_gpu_device(adapter_index(choice));
  return make_cpu_device(choice.threads, choice.precision);
}

}  // namespace pliant::app
