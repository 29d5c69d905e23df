// Makes the parts that the files of all suites have in common. Only their reports use it.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "bench/common/machine.hpp"
#include "bench/common/place.hpp"
#include "core/json.hpp"

namespace pliant::bench {

/// Returns the options as they were asked for. With 0 threads the CPU uses one a processor.
[[nodiscard]] Json options_json(const Selection& devices, bool quick);
/// Returns {suite, options, interrupted, machine}, with which every file starts.
[[nodiscard]] Json suite_json(const char* suite, const Json& options, bool interrupted, const Machine& machine);
/// Returns the same with {rows, notes}.
[[nodiscard]] Json results_json(const char* suite, const Machine& machine, const Json& options, bool interrupted, Json rows,
                                const std::vector<std::string>& notes);
/// Returns the CPU's threads, or null for the GPU.
[[nodiscard]] Json threads_json(DeviceKind device, unsigned threads);
/// Returns the CPU's threads, or "-" for the GPU.
[[nodiscard]] std::string threads_text(DeviceKind device, unsigned threads);
/// Returns a width for the longest text in a column.
template <class Row>
std::size_t width_of(const std::vector<Row>& rows, std::string Row::*text) {
  std::size_t width = 8;
  for (const Row& row : rows) width = std::max(width, (row.*text).size());
  return width;
}
/// Returns a file's text, with a line for each member and for each element of a list. Replaces bytes that are not UTF-8, because
/// a scene's name may have any. Expects an object.
[[nodiscard]] std::string text_of(const Json& object);

}  // namespace pliant::bench
