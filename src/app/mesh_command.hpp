// `pliant mesh`: reports what a mesh consists of and what is wrong with it, subdivides it and writes it.
#pragma once
#include <filesystem>
#include <string>

#include "mesh/subdivide.hpp"

namespace pliant::app {

struct MeshOptions {
  std::string mesh;  // a file or a generator
  bool json = false;
  unsigned subdivide = 0;  // how often
  Subdivision subdivision = Subdivision::midpoint;
  std::filesystem::path out;  // nowhere if empty
};

void show_mesh(const MeshOptions& options);

}  // namespace pliant::app
