#include "support/program.hpp"

#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <stdexcept>

#include "support/paths.hpp"

namespace pliant {
namespace {

int exit_code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : -1; }

int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace

ProgramResult run_program(const std::string& arguments, const std::string& before) {
  std::FILE* pipe = popen((before + program_path() + " " + arguments + " 2>&1").c_str(), "r");
  ProgramResult result;
  std::array<char, 4096> part{};
  while (std::size_t size = std::fread(part.data(), 1, part.size(), pipe)) result.output.append(part.data(), size);
  result.exit_code = exit_code_of(pclose(pipe));
  return result;
}

ProgramInTerminal::ProgramInTerminal(const std::vector<std::string>& arguments) {
  std::string path = program_path();
  std::vector<std::string> copies = arguments;
  std::vector<char*> pointers{path.data()};
  for (std::string& argument : copies) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  child_ = forkpty(&terminal_, nullptr, nullptr, nullptr);
  if (child_ < 0) throw std::runtime_error("there is no terminal to run the program in");
  if (child_ > 0) return;
  execv(path.c_str(), pointers.data());
  _exit(127);
}

ProgramInTerminal::~ProgramInTerminal() {
  if (child_ != 0) end_by(SIGKILL);
  close(terminal_);
}

// Blocks until there is something to read. Returns false at the end.
bool ProgramInTerminal::read_more() {
  std::array<char, 4096> part{};
  const ssize_t size = read(terminal_, part.data(), part.size());
  if (size > 0) output_.append(part.data(), static_cast<std::size_t>(size));
  return size > 0;
}

bool ProgramInTerminal::has_shown_progress(int times) {
  while (count_of(output_, "\r[") < times)
    if (!read_more()) return false;
  return true;
}

ProgramResult ProgramInTerminal::end_by(int signal) {
  kill(-child_, signal);
  while (read_more()) {
  }
  int status = 0;
  waitpid(child_, &status, 0);
  child_ = 0;
  return {exit_code_of(status), output_};
}

ProgramResult ProgramInTerminal::end_by_repeated(int signal) {
  pollfd shown{terminal_, POLLIN, 0};
  for (int silences = 0; silences < 600; ++silences) {
    kill(-child_, signal);
    while (poll(&shown, 1, 100) > 0)
      if (!read_more()) return end_by(signal);  // it has ended
  }
  return end_by(SIGKILL);
}

std::string shipped_scene(const std::string& name) { return source_dir() + "/scenes/" + name + ".toml"; }

}  // namespace pliant
