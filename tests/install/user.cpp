// The example of docs/library.md, and one thing of other modules, so that their headers and the libraries behind them must be
// there. Takes a scene file.
#include <cstdio>
#include <vector>

#include "dynamics/integrator.hpp"
#include "gl/context.hpp"
#include "model/load_bodies.hpp"
#include "scene/load_scene.hpp"
#include "simulation/simulation.hpp"

int main(int, char** arguments) {
  const pliant::SceneDescription scene = pliant::load_scene(arguments[1]);
  const auto [model, start] = pliant::build_model(pliant::load_bodies(scene), scene.simulation.gravity, scene.grounds);
  const auto device = pliant::make_cpu_device(0, 32);
  pliant::Simulation simulation(*device, model, start, pliant::plan_time(scene, model), scene.collision);
  simulation.advance(3);
  const std::vector<glm::vec4> positions = simulation.world_positions();
  std::printf("%zu integrators, %zu adapters\n", pliant::integrators().size(), pliant::gl::list_adapters().size());
  return simulation.report().steps == 3 && positions.size() == model.vertex_count() ? 0 : 1;
}
