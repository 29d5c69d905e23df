// This is a file of its own because it is compiled again after every commit.
#include "core/version.hpp"

#include "pliant_commit.hpp"  // written by the build, see cmake/PliantCommit.cmake

namespace pliant {

std::string version() { return PLIANT_VERSION; }

std::string commit() { return PLIANT_COMMIT; }

std::string full_version() { return version() + " (" + commit() + ")"; }

}  // namespace pliant
