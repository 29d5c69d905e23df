#include "app/sweep_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>

#include "core/error.hpp"
#include "core/program_folder.hpp"
#include "output/program_pipe.hpp"

#ifndef PLIANT_PYTHON_PROGRAM
#define PLIANT_PYTHON_PROGRAM ""
#endif

namespace pliant::app {
namespace {

constexpr const char* remedy =
    "install python3-pliant, or build the package by tools/build python. Another Python is taken if PLIANT_PYTHON names it";

// The Python that the package was built for, unless the user names another.
std::filesystem::path find_python() {
  if (const char* named = std::getenv("PLIANT_PYTHON"); named != nullptr && *named != '\0') return named;
  std::error_code unknown;
  if (std::filesystem::exists(PLIANT_PYTHON_PROGRAM, unknown)) return PLIANT_PYTHON_PROGRAM;
  if (const auto found = find_program("python3")) return *found;
  throw Error(ErrorKind::device, "pliant sweep", "needs Python, and there is no python3", remedy);
}

// The package beside this program comes first: in its build folder, or in the tree that both are installed in.
void lead_to_package() {
  const std::filesystem::path program = program_folder();
  for (const std::filesystem::path& folder : {program / "python", program.parent_path() / PLIANT_PYTHON_DIR}) {
    std::error_code none;
    if (!std::filesystem::exists(folder / "pliant" / "__init__.py", none)) continue;
    const char* others = std::getenv("PYTHONPATH");
    const bool are_others = others != nullptr && *others != '\0';
    setenv("PYTHONPATH", (folder.string() + (are_others ? ":" + std::string(others) : "")).c_str(), 1);
    return;
  }
}

void expect_package(const std::filesystem::path& python) {
  std::string account;
  try {
    const ProgramPipe::End tried = ProgramPipe(python, {"-P", "-c", "import pliant.sweep"}).finish();
    if (tried.succeeded) return;
    account = tried.account;
  } catch (const Error& error) {
    account = error.problem();
  }
  throw Error(ErrorKind::device, "pliant sweep", fmt::format("{} can't load the package pliant: {}", python.string(), account),
              remedy);
}

}  // namespace

void sweep(const std::vector<std::string>& arguments) {
  const std::filesystem::path python = find_python();
  lead_to_package();
  expect_package(python);
  // With -P the current folder is none of those where Python looks for modules.
  std::vector<std::string> words{python.string(), "-P", "-m", "pliant.sweep"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(python.c_str(), pointers.data());
  throw Error(ErrorKind::device, "pliant sweep", fmt::format("{} can't be started", python.string()), remedy);
}

}  // namespace pliant::app
