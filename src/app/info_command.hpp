// `pliant info`: shows the machine's devices, or pliant's integrators.
#pragma once

namespace pliant::app {

struct InfoOptions {
  bool json = false;
  bool integrators = false;
};

void show_info(const InfoOptions& options);

}  // namespace pliant::app
