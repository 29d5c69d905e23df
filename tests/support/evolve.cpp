#include "support/evolve.hpp"

#include "support/has.hpp"

namespace pliant {

std::vector<TestDevice> all_devices() {
  std::vector<TestDevice> devices;
  devices.push_back({"cpu, fp64", make_cpu_device(2, 64), 1e-16});
  devices.push_back({"cpu, fp32", make_cpu_device(2, 32), 6e-8});
  if (test::has_gl()) devices.push_back({"gpu", make_gpu_device(0), 6e-8});
  return devices;
}

}  // namespace pliant
