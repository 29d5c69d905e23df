// Uses one thing of several modules, so that their headers and the libraries behind them must be there.
#include <cstdio>

#include "dynamics/integrator.hpp"
#include "gl/context.hpp"
#include "model/model.hpp"

int main() {
  std::printf("%zu integrators, %zu adapters\n", pliant::integrators().size(), pliant::gl::list_adapters().size());
  return static_cast<int>(pliant::Model{}.vertex_count());
}
