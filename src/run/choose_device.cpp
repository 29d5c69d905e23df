#include "run/choose_device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <thread>

#include "core/counted.hpp"
#include "core/error.hpp"
#include "core/thread_pool.hpp"
#include "device/gpu/gpu_device.hpp"

namespace pliant {
namespace {

// Returns whether an automatic choice may take a GPU.
bool may_be_gpu(const DeviceChoice& choice) {
  return choice.wish.value_or(DeviceWish::automatic) == DeviceWish::automatic && choice.precision.value_or(32) == 32;
}

bool is_gpu(const DeviceChoice& choice) {
  const bool asked = choice.wish == DeviceWish::gpu || choice.gpu_index;
  return asked || (may_be_gpu(choice) && has_hardware_gpu());
}

std::size_t hardware_gpus() {
  return static_cast<std::size_t>(std::ranges::count(gl::list_adapters(), false, &gl::Adapter::is_software));
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

DeviceChoice choice_of_rank(DeviceChoice choice, const Ranks& ranks) {
  if (is_gpu(choice)) {
    if (!choice.gpu_index) choice.gpu_index = static_cast<int>(ranks.number_here() % std::max<std::size_t>(hardware_gpus(), 1));
  } else if (choice.threads == 0) {
    choice.threads = threads_of_rank(thread_count(0), std::thread::hardware_concurrency(), ranks.count_here());
  }
  return choice;
}

// Those that are bound to the same processors share them.
unsigned threads_of_rank(unsigned allowed, unsigned online, std::size_t ranks_here) {
  const std::size_t all = std::max({allowed, online, 1u}), sharers = (allowed * ranks_here + all - 1) / all;
  return std::max(static_cast<unsigned>(allowed / std::max<std::size_t>(sharers, 1)), 1u);
}

std::vector<std::string> told_of_ranks(const DeviceChoice& choice, const Ranks& ranks, const Model& model) {
  std::vector<std::string> told;
  const std::size_t gpus = !is_gpu(choice) ? 0 : choice.gpu_index ? 1 : hardware_gpus();
  if (gpus > 0 && ranks.count_here() > gpus)
    told.push_back(fmt::format("{} ranks share {}, which makes none faster; start one for each GPU", ranks.count_here(),
                               counted(gpus, "GPU", "GPUs")));
  if (const auto body = std::ranges::find_if(model.bodies, &ModelBody::is_clustered); body != model.bodies.end())
    told.push_back(
        fmt::format("each rank sums all springs of \"{}\" by clusters, so that more ranks make it no faster; forces = "
                    "\"direct\" shares them",
                    body->name));
  return told;
}

std::unique_ptr<Device> choose_device(const DeviceChoice& choice) {
  expect_consistent(choice);
  if (is_gpu(choice)) return make_gpu_device(choice.gpu_index.value_or(0));
  return make_cpu_device(choice.threads, choice.precision.value_or(32));
}

std::unique_ptr<Device> choose_device(const DeviceChoice& choice, gl::Context& window) {
  expect_consistent(choice);
  if ((may_be_gpu(choice) && !window.adapter().is_software) || choice.wish == DeviceWish::gpu) return make_gpu_device(window);
  return make_cpu_device(choice.threads, choice.precision.value_or(32));
}

}  // namespace pliant
