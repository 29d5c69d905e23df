// What the files of all suites have in common, for their reports alone.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "bench/machine.hpp"
#include "bench/place.hpp"

namespace pliant::bench {

[[nodiscard]] nlohmann::ordered_json machine_json(const Machine& machine);
/// What was asked for, not what came of it: threads 0 are one a processor.
[[nodiscard]] nlohmann::ordered_json options_json(const Selection& devices, bool quick);
/// Threads are the CPU's: null for the GPU.
[[nodiscard]] nlohmann::ordered_json threads_json(const std::string& device, unsigned threads);
/// As a file. Text that is no UTF-8 is replaced: a scene's name need not be any.
[[nodiscard]] std::string text_of(const nlohmann::ordered_json& json);

}  // namespace pliant::bench
