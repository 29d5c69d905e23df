#include "support/runs.hpp"

#include <algorithm>
#include <fstream>

#include "core/read_text.hpp"
#include "support/program.hpp"

namespace pliant::test {

std::size_t line_count(const std::string& text) { return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')); }

ReadJson summary_in(const std::filesystem::path& folder) { return ReadJson::parse(read_text(folder / "summary.json")); }

std::filesystem::path small_scene(const ScratchFolder& folder, const std::string& more) {
  const auto path = folder.path / "small.toml";
  std::ofstream(path) << "[simulation]\ntime_step = 0.01\nduration = 0.2\n"
                      << more
                      << "[output]\nsize = [160, 90]\n"
                         "[[body]]\nname = \"left\"\nmesh = \"icosphere:1\"\nposition = [-1.1, 0, 0]\nvelocity = [4, 0, 0]\n"
                         "[[body]]\nname = \"right\"\nmesh = \"icosphere:1\"\nposition = [1.1, 0, 0]\nstiffness = 20\n";
  return path;
}

void check_fails(const std::string& arguments, int exit_code, std::initializer_list<const char*> parts) {
  CAPTURE(arguments);
  const ProgramResult result = run_program(arguments);
  CHECK(result.exit_code == exit_code);
  for (const char* part : parts) CHECK_THAT(result.output, Catch::Contains(part));
}

}  // namespace pliant::test
