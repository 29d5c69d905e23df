// The pipe is a pair of sockets, because MSG_NOSIGNAL makes writing to a closed one an error instead of a signal.
#include "output/program_pipe.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <sstream>
#include <system_error>
#include <utility>

#include "core/error.hpp"

namespace pliant {
namespace {

Error not_started(const std::filesystem::path& program, int code) {
  return {ErrorKind::command_line, program.string(), std::string("can't be started: ") + std::strerror(code),
          "check that it runs by itself"};
}

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

// Returns an error code or 0.
int spawn(pid_t& child, std::vector<std::string> words, int input, int output) {
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  for (const int printed : {STDOUT_FILENO, STDERR_FILENO}) posix_spawn_file_actions_adddup2(&actions, output, printed);
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  const int code = posix_spawn(&child, words.front().c_str(), &actions, &attributes, pointers_to(words).data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  return code;
}

// The last line alone often says only that something failed. A line before it says what.
std::string last_lines_of(std::FILE* file) {
  std::rewind(file);
  std::deque<std::string> lines;
  std::string line;
  const auto end_line = [&] {
    if (!line.empty()) lines.push_back(std::exchange(line, {}));
    if (lines.size() > 3) lines.pop_front();
  };
  for (int c = 0; (c = std::fgetc(file)) != EOF;) {
    if (c == '\n' || c == '\r')
      end_line();
    else
      line += static_cast<char>(c);
  }
  end_line();
  return fmt::format("{}", fmt::join(lines, " | "));
}

std::string account_of(std::FILE* printed, int status) {
  std::string account = last_lines_of(printed);
  if (account.empty()) account = "it said nothing";
  if (WIFSIGNALED(status)) account += fmt::format(", and signal {} ended it: {}", WTERMSIG(status), strsignal(WTERMSIG(status)));
  return account;
}

}  // namespace

std::optional<std::filesystem::path> find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path program = std::filesystem::path(folder.empty() ? "." : folder) / name;
    std::error_code failure;
    if (std::filesystem::is_regular_file(program, failure) && access(program.c_str(), X_OK) == 0) return program;
  }
  return std::nullopt;
}

ProgramPipe::ProgramPipe(const std::filesystem::path& program, const std::vector<std::string>& arguments)
    : printed_(std::tmpfile()) {
  int ends[2];
  if (!printed_ || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) throw not_started(program, errno);
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const int code = spawn(child_, std::move(words), ends[1], fileno(printed_.get()));
  close(ends[1]);
  input_ = ends[0];
  if (code == 0) return;
  child_ = 0;
  close_input();
  throw not_started(program, code);
}

ProgramPipe::~ProgramPipe() {
  if (child_ != 0) finish();
}

void ProgramPipe::close_input() {
  if (input_ >= 0) close(input_);
  input_ = -1;
}

bool ProgramPipe::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent >= 0)
      bytes = bytes.subspan(static_cast<std::size_t>(sent));
    else if (errno != EINTR)
      return false;
  }
  return true;
}

ProgramPipe::End ProgramPipe::finish() {
  close_input();
  int status = 0;
  while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = 0;
  return {WIFEXITED(status) && WEXITSTATUS(status) == 0, account_of(printed_.get(), status)};
}

}  // namespace pliant
