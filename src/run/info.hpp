// Tells what there is to simulate on and with, for programs to read.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/json.hpp"
#include "dynamics/integrator.hpp"
#include "gl/context.hpp"

namespace pliant {

struct Gpus {
  std::vector<gl::Adapter> adapters;
  std::string missing;  // why there is none, and what to do about it; empty: there is one
};

[[nodiscard]] Gpus find_gpus();

/// Returns the damping that an integrator allows: "any", "constant" or "none".
[[nodiscard]] std::string_view damping_of(const Integrator& integrator);

/// Return what `pliant info --json` prints, and what it prints with --integrators.
[[nodiscard]] Json info(const Gpus& gpus);
[[nodiscard]] Json info_of_integrators();

}  // namespace pliant
