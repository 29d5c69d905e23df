#include "collision/responses/round_kernels.hpp"

#include <algorithm>
#include <array>

#include "device/device.hpp"
#include "physics/body.glsl"
#include "physics/contact/surface.glsl"

namespace pliant {

RoundKernels::RoundKernels(Arrays& arrays, std::uint32_t most_groups) : arrays_(arrays), most_groups_(most_groups) {
  arrays.set_parameter("is_rehearsal", 0u);
}

Pass RoundKernels::pass_of(std::string_view name, const Parameters& parameters, std::uint32_t groups) const {
  return make_pass(arrays_, name, arrays_.device().round_kernel(name), parameters, groups);
}

bool RoundKernels::all_meet(std::string_view name, Parameters parameters, std::uint32_t groups) const {
  parameters.emplace_back("is_rehearsal", 1u);
  auto& lists = arrays_.get<physics::ContactList>("contact_list");
  arrays_.device().run(std::array{pass_of(name, parameters, groups)});
  physics::ContactList list = lists.download().front();
  if ((list.arrivals & physics::waited_in_vain) == 0) return true;
  list.arrivals = 0;
  lists.upload({&list, 1});
  return false;
}

Pass RoundKernels::pass(std::string_view name, const Parameters& parameters) const {
  auto found = groups_of_.find(name);
  if (found == groups_of_.end()) {
    std::uint32_t groups = std::max(most_groups_, 1u);
    while (groups > 1 && !all_meet(name, parameters, groups)) groups /= 2;
    found = groups_of_.emplace(name, groups).first;
  }
  return pass_of(name, parameters, found->second);
}

}  // namespace pliant
