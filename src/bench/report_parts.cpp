#include "bench/report_parts.hpp"

#include <nlohmann/json.hpp>
#include <optional>

namespace pliant::bench {

using Json = nlohmann::ordered_json;

namespace {

Json or_null(const std::optional<std::string>& value) { return value ? Json(*value) : Json(nullptr); }

}  // namespace

Json machine_json(const Machine& machine) {
  return {{"version", machine.version},         {"commit", machine.commit},    {"cpu", machine.cpu},
          {"cpu_threads", machine.cpu_threads}, {"gpu", or_null(machine.gpu)}, {"driver", or_null(machine.driver)},
          {"compiler", machine.compiler},       {"date", machine.date}};
}

Json options_json(const Selection& devices, bool quick) {
  return {{"cpu", devices.cpu},
          {"gpu", devices.gpu},
          {"gpu_index", devices.gpu_index},
          {"threads", devices.threads},
          {"quick", quick}};
}

Json threads_json(const std::string& device, unsigned threads) { return device == "gpu" ? Json(nullptr) : Json(threads); }

std::string text_of(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n'; }

}  // namespace pliant::bench
