// An X display of the test's own, without a screen, and programs in it.
#pragma once
#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "render/image.hpp"

namespace pliant::test {

/// A child whose standard output is read line by line. It ends with this object or with the tests at the latest.
class Child {
 public:
  /// `command` is a program with its arguments, looked for in PATH. Standard error is the tests' own.
  Child(std::vector<std::string> command, const std::vector<std::pair<std::string, std::string>>& environment = {},
        const std::filesystem::path& folder = {});
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Waits for a line. Throws if no more lines come, or none for a minute.
  std::string read_line();
  /// Reads until the end, for a minute at most, and gives the exit code.
  int wait_for_end();
  [[nodiscard]] pid_t id() const { return id_; }

 private:
  bool read_more();
  pid_t id_ = 0;  // 0: it has ended
  int output_ = -1;
  std::string unread_;
};

/// Xvfb with openbox, on a number that nobody else has.
class VirtualDisplay {
 public:
  /// What a test needs and this machine lacks. Empty if all is there.
  static std::string missing();
  VirtualDisplay();

  [[nodiscard]] const std::string& name() const { return name_; }  // such as ":1"
  /// Runs a shell command in the display, such as xdotool, and returns its output. Throws if the command fails.
  [[nodiscard]] std::string run(const std::string& command) const;
  /// Drops a file on a window, as a file manager would.
  void drop(const std::filesystem::path& file, const std::string& window) const;
  /// Tells programs that start later that there are twice as many dots per inch as usual.
  void make_dense() const;
  /// What a window shows.
  [[nodiscard]] render::Image picture_of(const std::string& window) const;

 private:
  std::unique_ptr<Child> server_, window_manager_;
  std::string name_;
};

}  // namespace pliant::test
