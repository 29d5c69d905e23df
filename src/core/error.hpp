// The one exception type. It says what is wrong, where, and how to mend it.
#pragma once
#include <stdexcept>
#include <string>
#include <utility>

#include "core/origin.hpp"

namespace pliant {

/// What kind of thing went wrong. The values are the program's exit codes.
enum class ErrorKind { command_line = 2, input = 3, device = 4 };

/// Thrown while loading and building, and when a device fails. Numbers that diverge throw nothing.
class Error : public std::runtime_error {
 public:
  /// `place` names a file, line, field or element. `remedy` says what to do about it. Both may be empty.
  Error(ErrorKind kind, std::string place, std::string problem, std::string remedy)
      : std::runtime_error(joined(place, ": ", problem) + (remedy.empty() ? "" : "; " + remedy)),
        kind_(kind),
        place_(std::move(place)),
        problem_(std::move(problem)),
        remedy_(std::move(remedy)) {}

  /// The kind is command_line or input, depending on where the value was given.
  Error(const Origin& where, std::string problem, std::string remedy)
      : Error(kind_of(where), where.place, std::move(problem), std::move(remedy)) {}

  [[nodiscard]] ErrorKind kind() const { return kind_; }
  [[nodiscard]] const std::string& place() const { return place_; }
  [[nodiscard]] const std::string& problem() const { return problem_; }
  [[nodiscard]] const std::string& remedy() const { return remedy_; }

  /// Return the same error in a wider place, such as the scene that names a file. The kind may become another.
  [[nodiscard]] Error within(ErrorKind kind, const std::string& place) const {
    return {kind, joined(place, place_.empty() ? "" : ": ", place_), problem_, remedy_};
  }
  [[nodiscard]] Error within(const Origin& where) const { return within(kind_of(where), where.place); }

 private:
  static ErrorKind kind_of(const Origin& where) { return where.is_command_line() ? ErrorKind::command_line : ErrorKind::input; }
  static std::string joined(const std::string& front, const char* between, const std::string& back) {
    return front.empty() ? back : front + between + back;
  }

  ErrorKind kind_;
  std::string place_, problem_, remedy_;
};

}  // namespace pliant
