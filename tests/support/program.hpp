// Runs the built program as a shell would, or in a terminal of its own.
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace pliant {

struct ProgramResult {
  int exit_code = -1;
  std::string output;  // standard output and error together
};

/// `arguments` is a shell command line behind the program's name. `before` stands before the name, such as "ulimit -v 1000;".
ProgramResult run_program(const std::string& arguments, const std::string& before = "");

/// The program in a terminal, where it shows progress, each time behind "\r[". The destructor kills it if it still runs.
class ProgramInTerminal {
 public:
  explicit ProgramInTerminal(const std::vector<std::string>& arguments);
  ~ProgramInTerminal();
  ProgramInTerminal(const ProgramInTerminal&) = delete;
  ProgramInTerminal& operator=(const ProgramInTerminal&) = delete;

  /// Waits until the program has shown progress so many times in all. Returns false if the program ends before.
  [[nodiscard]] bool has_shown_progress(int times);
  /// Sends the signal to the program and what it has started in its group, as a terminal does. Then waits for the end.
  ProgramResult end_by(int signal);
  /// Sends the signal again whenever the program has been silent for a moment. Kills the program after a minute of that.
  ProgramResult end_by_repeated(int signal);

 private:
  bool read_more();
  pid_t child_ = 0;  // 0: it has ended
  int terminal_ = -1;
  std::string output_;
};

std::string shipped_scene(const std::string& name);  // its path

}  // namespace pliant
