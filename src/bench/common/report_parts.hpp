// What the files of all suites have in common, for their reports alone.
#pragma once
#include <iterator>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "bench/common/machine.hpp"
#include "bench/common/place.hpp"

namespace pliant::bench {

using Json = nlohmann::ordered_json;

/// What was asked for, not what came of it: threads 0 are one a processor.
[[nodiscard]] Json options_json(const Selection& devices, bool quick);
/// {suite, options, interrupted, machine}, with which every file starts.
[[nodiscard]] Json suite_json(const char* suite, const Json& options, bool interrupted, const Machine& machine);
/// Threads are the CPU's: null for the GPU.
[[nodiscard]] Json threads_json(const std::string& device, unsigned threads);
/// As a file: a line for each member, and for each element of a list. Text that is no UTF-8 is replaced: a scene's name need not
/// be any. Expects an object.
[[nodiscard]] std::string text_of(const Json& object);

[[nodiscard]] Json or_null(const std::optional<double>& value);
[[nodiscard]] Json or_null(const std::optional<std::string>& value);

/// `json_of` answers Json. Its type is deduced, as it is known here by name alone.
template <class Items, class ToJson>
[[nodiscard]] auto list_of(const Items& items, const ToJson& json_of) {
  using List = decltype(json_of(*std::begin(items)));
  List list = List::array();
  for (const auto& item : items) list.push_back(json_of(item));
  return list;
}

}  // namespace pliant::bench
