#include "mesh/load.hpp"

#include <system_error>

#include "core/error.hpp"
#include "mesh/generators.hpp"

namespace pliant {

LoadedMesh load_mesh(std::string_view description, const std::filesystem::path& base_folder, const ReadProgress& progress) {
  if (is_generator(description)) return {generate_mesh(description), {}};
  const std::filesystem::path path = base_folder / description;
  if (std::error_code ignored; !std::filesystem::exists(path, ignored))
    throw Error(ErrorKind::input, path.string(), "there is no such file",
                "name an OBJ file that exists, or " + generator_forms());
  return load_obj(path, progress);
}

}  // namespace pliant
