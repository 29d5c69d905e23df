// Says where a value was given, and so whose mistake it is when it is wrong.
#pragma once
#include <string>

namespace pliant {

struct Origin {
  /// Values of later kinds replace those of earlier kinds. An override is `--set key=value`. An option has a name of its own.
  enum class From { nowhere, file, override, option };

  From from = From::nowhere;
  std::string place;  // such as "scene.toml:3: simulation.duration", "--set key=value: key" or "--duration"

  [[nodiscard]] bool is_command_line() const { return from >= From::override; }
};

[[nodiscard]] inline Origin option_origin(const char* name) { return {Origin::From::option, name}; }

}  // namespace pliant
