// Makes the parts that the files of all suites have in common. Only their reports use it.
#pragma once
#include <string>

#include "bench/common/machine.hpp"
#include "bench/common/place.hpp"
#include "core/json.hpp"

namespace pliant::bench {

/// Returns the options as they were asked for. With 0 threads the CPU uses one a processor.
[[nodiscard]] Json options_json(const Selection& devices, bool quick);
/// Returns {suite, options, interrupted, machine}, with which every file starts.
[[nodiscard]] Json suite_json(const char* suite, const Json& options, bool interrupted, const Machine& machine);
/// Returns the CPU's threads, or null for the GPU.
[[nodiscard]] Json threads_json(const std::string& device, unsigned threads);
/// Returns a file's text, with a line for each member and for each element of a list. Replaces bytes that are not UTF-8, because
/// a scene's name may have any. Expects an object.
[[nodiscard]] std::string text_of(const Json& object);

}  // namespace pliant::bench
