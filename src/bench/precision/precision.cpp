#include "bench/precision/precision.hpp"

#include <memory>
#include <string>
#include <utility>

#include "bench/peers/peers.hpp"
#include "bench/precision/cases.hpp"
#include "bench/precision/runs.hpp"
#include "bench/precision/sweeps.hpp"

namespace pliant::bench {
namespace {

constexpr SweepLimits full_limits{.longest_run = 1.5, .most_evaluations = 4000, .rounds = 3};
constexpr SweepLimits quick_limits{.longest_run = 0.15, .most_evaluations = 1200, .rounds = 3};

PrecisionCaseInfo info_of(const PrecisionCase& what, double reference_error) {
  return {.name = what.name,
          .vertices = what.start.model.vertex_count(),
          .bodies = static_cast<std::uint32_t>(what.start.model.bodies.size()),
          .damping_law = name_of(what.damping_law),
          .duration = what.duration,
          .omega = what.omega,
          .reference_step = what.omega * what.duration / (2.0 * static_cast<double>(what.reference_steps)),
          .reference_error = reference_error,
          .is_contest = what.is_contest};
}

class Suite {
 public:
  Suite(const PrecisionOptions& options, const Progress& progress)
      : limits_(options.quick ? quick_limits : full_limits),
        places_(choose_places(options)),
        all_(make_precision_cases(options.scenes, options.quick)),
        progress_(progress) {
    result_.notes = all_.notes;
    if (!sundials_version().empty()) result_.versions["SUNDIALS"] = sundials_version();
    if (!boost_version().empty()) result_.versions["Boost"] = boost_version();
    for (std::string& missing : missing_peers()) result_.notes.push_back(std::move(missing));
    for (const Place& place : places_) devices_.push_back(open(place));
    reference_device_ = make_cpu_device(options.devices.threads, 64);
  }

  PrecisionResult run() && {
    for (std::size_t k = 0; k < all_.cases.size() && !result_.interrupted; ++k)
      result_.interrupted = !measure(all_.cases[k], static_cast<double>(k) / static_cast<double>(all_.cases.size()));
    if (!result_.interrupted) progress_(1, "");
    return std::move(result_);
  }

 private:
  // Quick measurements all run on one thread.
  static std::vector<Place> choose_places(const PrecisionOptions& options) {
    constexpr int precisions[] = {64, 32};
    std::vector<Place> places = places_of(options.devices, precisions);
    if (options.quick)
      std::erase_if(places, [](const Place& place) { return place.device == DeviceKind::cpu && place.threads > 1; });
    return places;
  }

  bool measure(const PrecisionCase& what, double done) {
    if (!progress_(done, what.name + ", reference")) return false;
    Reference reference = find_reference(*reference_device_, what);
    result_.cases.push_back(info_of(what, reference.error));
    Sweeps sweeps(what, std::move(reference), limits_, [&](std::string_view next) { return progress_(done, next); });
    const bool on = sweep(sweeps, what) && sweeps.repeat();
    result_.cases.back().is_complete = on;
    const std::vector<PrecisionRow> rows = sweeps.rows();
    result_.rows.insert(result_.rows.end(), rows.begin(), rows.end());
    return on;
  }

  bool sweep(Sweeps& sweeps, const PrecisionCase& what) {
    for (std::size_t p = 0; p < places_.size(); ++p) {
      static_cast<void>(run_steps(*devices_[p], what, find_integrator("dop853"), 1));  // builds the kernels
      if (!sweeps.steps(*devices_[p], places_[p])) return false;
      if (what.with_tolerances && !sweeps.tolerances(*devices_[p], places_[p])) return false;
      if (p > 0 || !what.with_peers || places_[p].device != DeviceKind::cpu) continue;
      if (!sweeps.peers()) return false;
      result_.cases.back().seconds_of_rates = sweeps.seconds_of_rates();
    }
    return true;
  }

  SweepLimits limits_;
  std::vector<Place> places_;
  PrecisionCases all_;
  const Progress& progress_;
  std::vector<std::unique_ptr<Device>> devices_;
  std::unique_ptr<Device> reference_device_;
  PrecisionResult result_;
};

}  // namespace

PrecisionResult bench_precision(const PrecisionOptions& options, const Progress& progress) {
  return Suite(options, progress).run();
}

}  // namespace pliant::bench
