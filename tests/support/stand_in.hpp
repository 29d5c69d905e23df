// A script that stands in for a program on PATH.
#pragma once
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace pliant::test {

/// While this lives, the shell script `text` is the first program called `name`. The folder has to be for this alone.
class StandIn {
 public:
  StandIn(const std::filesystem::path& folder, const std::string& name, const std::string& text) {
    std::filesystem::create_directories(folder);
    std::ofstream(folder / name) << "#!/bin/sh\n" << text;
    std::filesystem::permissions(folder / name, std::filesystem::perms::owner_all);
    setenv("PATH", (folder.string() + ":" + before_).c_str(), 1);
  }
  ~StandIn() { setenv("PATH", before_.c_str(), 1); }
  StandIn(const StandIn&) = delete;
  StandIn& operator=(const StandIn&) = delete;

 private:
  std::string before_ = std::getenv("PATH");
};

}  // namespace pliant::test
