// Another program that is fed through its standard input.
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

/// Where PATH has an executable of that name.
[[nodiscard]] std::optional<std::filesystem::path> find_program(const std::string& name);

/// The program runs without a shell, in a process group of its own: Ctrl-C is not for it. What it prints is kept for its end.
class ProgramPipe {
 public:
  struct End {
    bool succeeded = false;
    std::string account;  // its last three lines, and the signal that ended it; never empty
  };

  /// Throws Error (command_line) when it can't be started.
  ProgramPipe(const std::filesystem::path& program, const std::vector<std::string>& arguments);
  /// Ends its input and waits for its end.
  ~ProgramPipe();
  ProgramPipe(const ProgramPipe&) = delete;
  ProgramPipe& operator=(const ProgramPipe&) = delete;

  /// Waits until the program has taken the bytes, or nearly. False when it takes no more.
  [[nodiscard]] bool write(std::span<const std::byte> bytes);
  /// Ends its input and waits for its end; once.
  End finish();

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void close_input();

  std::unique_ptr<std::FILE, CloseFile> printed_;  // a file, for nobody reads it meanwhile: a full pipe would stop the program
  int input_ = -1;                                 // -1: it has ended
  pid_t child_ = 0;                                // 0: it has been waited for
};

}  // namespace pliant
