// Runs another program and feeds it through its standard input.
#pragma once
#include <sys/types.h>

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pliant {

/// Returns the first executable of that name on PATH, or nothing.
[[nodiscard]] std::optional<std::filesystem::path> find_program(const std::string& name);

/// Runs the program without a shell. It has its own process group, so Ctrl-C does not end it. What it prints is kept until its
/// end.
class ProgramPipe {
 public:
  struct End {
    bool succeeded = false;
    std::string account;  // its last three lines, and the signal that ended it; never empty
  };

  /// Starts the program. Throws Error (command_line) if it can't.
  ProgramPipe(const std::filesystem::path& program, const std::vector<std::string>& arguments);
  /// Ends its input and waits for its end.
  ~ProgramPipe();
  ProgramPipe(const ProgramPipe&) = delete;
  ProgramPipe& operator=(const ProgramPipe&) = delete;

  /// Waits until the pipe has taken all bytes. Returns false if the program takes no more.
  [[nodiscard]] bool write(std::span<const std::byte> bytes);
  /// Ends its input and waits for its end. Call it once at most.
  End finish();

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void close_input();

  std::unique_ptr<std::FILE, CloseFile> printed_;  // nobody reads it until the end, so a pipe could fill up and stop the program
  int input_ = -1;                                 // -1: it has ended
  pid_t child_ = 0;                                // 0: it has been waited for
};

}  // namespace pliant
