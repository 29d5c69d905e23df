// `pliant info`: what this machine offers pliant, and what pliant offers.
#pragma once

namespace pliant::app {

struct InfoOptions {
  bool json = false;
  bool integrators = false;
};

void show_info(const InfoOptions& options);

}  // namespace pliant::app
