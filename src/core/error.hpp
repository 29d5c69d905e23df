// The one exception type. It says what is wrong, where, and how to mend it.
#pragma once
#include <stdexcept>
#include <string>

#include "core/origin.hpp"

namespace pliant {

/// What kind of thing went wrong. The values are the program's exit codes.
enum class ErrorKind { command_line = 2, input = 3, device = 4 };

/// Thrown while loading and building, and when a device fails. Numbers that diverge throw nothing.
class Error : public std::runtime_error {
 public:
  /// `where` names a file, line, field or element. `remedy` says what to do about it. Both may be empty.
  Error(ErrorKind kind, const std::string& where, const std::string& what, const std::string& remedy)
      : std::runtime_error((where.empty() ? "" : where + ": ") + what + (remedy.empty() ? "" : "; " + remedy)), kind_(kind) {}

  /// The kind is command_line or input, depending on where the value was given.
  Error(const Origin& where, const std::string& what, const std::string& remedy)
      : Error(where.is_command_line() ? ErrorKind::command_line : ErrorKind::input, where.place, what, remedy) {}

  [[nodiscard]] ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

}  // namespace pliant
