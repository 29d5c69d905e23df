#include "mesh/load.hpp"

#include "mesh/generators.hpp"

namespace pliant {

LoadedMesh load_mesh(std::string_view description, const std::filesystem::path& base_folder) {
  if (is_generator(description)) return {generate_mesh(description), {}};
  return load_obj(base_folder / description);
}

}  // namespace pliant
