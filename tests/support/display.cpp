#include "support/display.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <stdexcept>

#include "support/paths.hpp"

namespace pliant::test {
namespace {

// How long a child may say nothing [ms]. Mesa compiles the kernels of contact for two minutes where they are not in its cache,
// and for longer beside other tests.
constexpr int patience = 600000;

[[noreturn]] void become(std::vector<std::string>& command) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::vector<char*> pointers;
  for (std::string& part : command) pointers.push_back(part.data());
  pointers.push_back(nullptr);
  execvp(pointers.front(), pointers.data());
  _exit(127);
}

int exit_code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : -1; }

/// A window dump's header: 32-bit numbers, the highest byte first.
class WindowDump {
 public:
  explicit WindowDump(std::span<const unsigned char> bytes) : bytes_(bytes) {
    if (bytes.size() < 100 || number(1) != 7 || number(11) != 32 || bytes.size() < first_pixel() + number(12) * number(5))
      throw std::runtime_error("this is no window dump of 32 bits a pixel");
  }

  [[nodiscard]] render::Image image() const {
    render::Image image{number(4), number(5), {}};
    const bool blue_is_first = number(7) == 0;  // the lowest byte is
    for (std::uint32_t y = 0; y < image.height; ++y)
      for (std::uint32_t x = 0; x < image.width; ++x) {
        const auto pixel = bytes_.subspan(first_pixel() + std::size_t{y} * number(12) + std::size_t{4} * x, 4);
        for (std::size_t channel = 0; channel < 3; ++channel)
          image.pixels.push_back(pixel[blue_is_first ? 2 - channel : 1 + channel]);
      }
    return image;
  }

 private:
  [[nodiscard]] std::uint32_t number(std::size_t index) const {
    const unsigned char* b = bytes_.data() + 4 * index;
    return static_cast<std::uint32_t>(b[0] << 24 | b[1] << 16 | b[2] << 8 | b[3]);
  }
  [[nodiscard]] std::size_t first_pixel() const { return number(0) + std::size_t{12} * number(19); }  // behind the colours

  std::span<const unsigned char> bytes_;
};

}  // namespace

Child::Child(std::vector<std::string> command, const std::vector<std::pair<std::string, std::string>>& environment,
             const std::filesystem::path& folder) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("there is no pipe for a child");
  id_ = fork();
  if (id_ == 0) {
    for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
    if (!folder.empty() && chdir(folder.c_str()) != 0) _exit(127);
    dup2(ends[1], STDOUT_FILENO);
    become(command);
  }
  close(ends[1]);
  output_ = ends[0];
  if (id_ < 0) throw std::runtime_error("there is no process for a child");
}

Child::~Child() {
  if (id_ > 0) {
    kill(id_, SIGTERM);
    waitpid(id_, nullptr, 0);
  }
  close(output_);
}

// Returns false at the end.
bool Child::read_more() {
  pollfd readable{output_, POLLIN, 0};
  if (poll(&readable, 1, patience) != 1) throw std::runtime_error("a child has said nothing for ten minutes; unread: " + unread_);
  std::array<char, 4096> part{};
  const ssize_t size = read(output_, part.data(), part.size());
  if (size > 0) unread_.append(part.data(), static_cast<std::size_t>(size));
  return size > 0;
}

std::string Child::read_line() {
  std::size_t end = 0;
  while ((end = unread_.find('\n')) == std::string::npos)
    if (!read_more()) throw std::runtime_error("a child has ended instead of saying more; unread: " + unread_);
  std::string line = unread_.substr(0, end);
  unread_.erase(0, end + 1);
  return line;
}

int Child::wait_for_end() {
  while (read_more()) {
  }
  int status = 0;
  waitpid(std::exchange(id_, 0), &status, 0);
  return exit_code_of(status);
}

std::string VirtualDisplay::missing() {
  std::string names;
  for (const auto& [name, check] : {std::pair{"Xvfb", "command -v Xvfb"},
                                    {"openbox", "command -v openbox"},
                                    {"xdotool", "command -v xdotool"},
                                    {"xwd", "command -v xwd"},
                                    {"Xlib for Python", "/usr/bin/python3 -c 'import Xlib'"}})
    if (std::system((std::string(check) + " > /dev/null 2>&1").c_str()) != 0)
      names += (names.empty() ? "" : ", ") + std::string(name);
  return names;
}

void VirtualDisplay::drop(const std::filesystem::path& file, const std::string& window) const {
  (void)run("/usr/bin/python3 " + source_dir() + "/tests/support/drop_file.py " + window + " " + file.string());
}

void VirtualDisplay::make_dense() const {
  (void)run(
      "/usr/bin/python3 -c 'from Xlib import X, Xatom, display; here = display.Display(); "
      "here.screen().root.change_property(Xatom.RESOURCE_MANAGER, Xatom.STRING, 8, b\"Xft.dpi: 192\"); here.sync()'");
}

VirtualDisplay::VirtualDisplay()
    : server_(std::make_unique<Child>(
          std::vector<std::string>{"Xvfb", "-displayfd", "1", "-screen", "0", "1000x700x24", "-nolisten", "tcp"})) {
  name_ = ":" + server_->read_line();
  window_manager_ = std::make_unique<Child>(std::vector<std::string>{"openbox", "--startup", "echo ready"},
                                            std::vector<std::pair<std::string, std::string>>{{"DISPLAY", name_}});
  while (window_manager_->read_line() != "ready") {
  }
}

std::string VirtualDisplay::run(const std::string& command) const {
  std::FILE* pipe = popen(("DISPLAY=" + name_ + " " + command).c_str(), "r");
  std::string output;
  std::array<char, 4096> part{};
  while (const std::size_t size = std::fread(part.data(), 1, part.size(), pipe)) output.append(part.data(), size);
  if (const int code = exit_code_of(pclose(pipe)); code != 0)
    throw std::runtime_error(command + " ended with exit code " + std::to_string(code));
  return output;
}

render::Image VirtualDisplay::picture_of(const std::string& window) const {
  const std::string dump = run("xwd -silent -id " + window);
  return WindowDump({reinterpret_cast<const unsigned char*>(dump.data()), dump.size()}).image();
}

}  // namespace pliant::test
