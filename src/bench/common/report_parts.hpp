// What the files of all suites have in common, for their reports alone.
#pragma once
#include <string>

#include "bench/common/machine.hpp"
#include "bench/common/place.hpp"
#include "core/json.hpp"

namespace pliant::bench {

/// What was asked for, not what came of it: threads 0 are one a processor.
[[nodiscard]] Json options_json(const Selection& devices, bool quick);
/// {suite, options, interrupted, machine}, with which every file starts.
[[nodiscard]] Json suite_json(const char* suite, const Json& options, bool interrupted, const Machine& machine);
/// Threads are the CPU's: null for the GPU.
[[nodiscard]] Json threads_json(const std::string& device, unsigned threads);
/// As a file: a line for each member, and for each element of a list. Text that is no UTF-8 is replaced: a scene's name need not
/// be any. Expects an object.
[[nodiscard]] std::string text_of(const Json& object);

}  // namespace pliant::bench
