#include "bench/forces/forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "bench/common/shapes.hpp"
#include "bench/forces/peak_rate.hpp"
#include "bench/forces/spring_cost.hpp"
#include "device/cpu/peak.hpp"
#include "dynamics/stepper.hpp"
#include "mesh/generators.hpp"
#include "state/device_bodies.hpp"

namespace pliant::bench {
namespace {

constexpr double longest_evaluation = 2;  // [s]
constexpr double shortest_peak = 0.01;    // batch of multiply-adds [s], so that no disturbance lasts all of it

std::vector<ModelAndState> bodies_of_all_sizes(bool quick) {
  std::vector<ModelAndState> bodies;
  for (int n = 2; n <= (quick ? 3 : 7); ++n) bodies.push_back(deformed_body(generate_mesh(fmt::format("icosphere:{}", n))));
  if (!quick) bodies.push_back(deformed_body(spiral_sphere(1u << 18)));
  return bodies;
}

std::optional<cpu::Isa> isa_named(std::string_view name) {
  for (const cpu::Isa isa : cpu::available_isas())
    if (cpu::name_of(isa) == name) return isa;
  return std::nullopt;
}

double pair_count(std::uint32_t vertices) { return static_cast<double>(vertices) * (static_cast<double>(vertices) - 1); }

// Measures the variants of one place, each over all sizes.
class ForcesAt {
 public:
  ForcesAt(const Place& place, const ForcesOptions& options)
      : place_(place),
        all_variants_(options.all_variants),
        effort_(options.quick ? quick_effort : Effort{}),
        device_(open(place)) {
    warm_up();
  }

  // Returns the variants to measure for a size: all, or the CPU's instruction sets, or the GPU's fastest one.
  std::vector<std::size_t> variants_for(std::uint32_t vertices) const {
    if (!on_cpu() && !all_variants_) return {fastest_force_variant(device_->force_variants(), vertices, vertices)};
    std::vector<std::size_t> chosen;
    for (std::size_t v = 0; v < device_->force_variants().size(); ++v)
      if (all_variants_ || sums_in_tiles(v)) chosen.push_back(v);
    return chosen;
  }

  const std::string& name_of_variant(std::size_t variant) const { return device_->force_variants()[variant].name; }

  // Returns the expected time of one evaluation, or 0 before the variant's first row.
  double expected_seconds(std::uint32_t vertices, std::size_t variant) const {
    const auto known = seconds_per_pair_.find(variant);
    return known == seconds_per_pair_.end() ? 0 : known->second * pair_count(vertices);
  }

  void measure(const ModelAndState& body, std::size_t variant) {
    const std::uint32_t vertices = body.model.vertex_count();
    const Timing seconds = seconds_of_forces(body, variant);
    seconds_per_pair_[variant] = seconds.median / pair_count(vertices);
    look_at_peak(isa_of(variant));
    rows_.push_back({.device = place_.device,
                     .precision = place_.precision,
                     .threads = place_.threads,
                     .isa = on_cpu() ? std::string(cpu::name_of(isa_of(variant))) : "opengl",
                     .form = "cancellation_free",
                     .variant = name_of_variant(variant),
                     .vertices = vertices,
                     .seconds_per_evaluation = seconds.median,
                     .fastest_seconds_per_evaluation = seconds.fastest,
                     .pairs_per_second = pair_count(vertices) / seconds.median});
    variants_.push_back(variant);
  }

  // Returns all rows with their bounds.
  std::vector<ForcesRow> rows() const {
    std::vector<ForcesRow> bounded = rows_;
    for (std::size_t k = 0; k < bounded.size(); ++k) set_bound(bounded[k], variants_[k]);
    return bounded;
  }

 private:
  bool on_cpu() const { return place_.device == DeviceKind::cpu; }

  // Raises a processor's clock by load. A GPU has a load before each of its times.
  void warm_up() {
    if (!on_cpu()) return;
    static_cast<void>(multiply_adds_per_second(*device_, place_, std::nullopt, {.batch_seconds = 0.1, .batches = 3}));
  }

  Timing seconds_of_forces(const ModelAndState& body, std::size_t variant) {
    DeviceBodies bodies(*device_, body.model, body.state, variant);
    const Stepper stepper(bodies, body.model, find_integrator("verlet"), DampingLaw::none, 1e-3);
    device_->run(stepper.first_passes());
    const std::vector<Pass> passes = stepper.refresh_passes();  // kept forces stay marked as stale, so they sum them every time
    return seconds_each(*device_, effort_, [&] { device_->run(passes); });
  }

  // The CPU's variants are named after instruction sets, except the plain one, which is compiled for every processor.
  bool sums_in_tiles(std::size_t variant) const { return on_cpu() && isa_named(name_of_variant(variant)); }

  // peaks_ keeps the GPU's peak under `portable`.
  cpu::Isa isa_of(std::size_t variant) const {
    return sums_in_tiles(variant) ? *isa_named(name_of_variant(variant)) : cpu::Isa::portable;
  }

  // Measures the peak again for every row and keeps the highest, because other load on the machine can only lower it.
  void look_at_peak(cpu::Isa isa) {
    const Effort effort{
        .batch_seconds = std::max(effort_.batch_seconds, shortest_peak), .batches = 5, .gpu_load_seconds = 0};  // forces were one
    peaks_[isa] = std::max(peaks_[isa], multiply_adds_per_second(*device_, place_, isa, effort));
  }

  void set_bound(ForcesRow& row, std::size_t variant) const {
    const cpu::Isa isa = isa_of(variant);
    const bool fused = !on_cpu() || cpu::fuses_multiply_adds(isa);
    const InstructionCount pair =
        sums_in_tiles(variant) ? instructions_of_pair_in_tiles(isa, row.precision) : instructions_of_pair;
    row.multiply_adds_per_second = peaks_.at(isa);
    row.bound_pairs_per_second = bound_of_pairs_per_second(row.multiply_adds_per_second, pair, fused);
    row.ratio_to_bound = row.pairs_per_second / row.bound_pairs_per_second;
  }

  Place place_;
  bool all_variants_;
  Effort effort_;
  std::unique_ptr<Device> device_;
  std::map<std::size_t, double> seconds_per_pair_;  // by variant, at the largest size so far
  std::map<cpu::Isa, double> peaks_;                // the highest multiply-adds a second so far
  std::vector<ForcesRow> rows_;                     // without bounds
  std::vector<std::size_t> variants_;               // of the rows
};

// Measures every variant of one size, or notes why not. Returns false if `progress` says to end.
bool measure_size(ForcesAt& here, const ModelAndState& body, const std::string& place, double done, const Progress& progress,
                  std::vector<std::string>& notes) {
  const std::uint32_t vertices = body.model.vertex_count();
  for (const std::size_t variant : here.variants_for(vertices)) {
    const std::string what = fmt::format("{}, {}, {} vertices", place, here.name_of_variant(variant), vertices);
    if (!progress(done, what)) return false;
    if (const double seconds = here.expected_seconds(vertices, variant); seconds > longest_evaluation)
      notes.push_back(fmt::format("{}: left out, as a sum would take about {:.2g} s", what, seconds));
    else
      here.measure(body, variant);
  }
  return true;
}

}  // namespace

ForcesResult bench_forces(const ForcesOptions& options, const Progress& progress) {
  constexpr int precisions[] = {32, 64};
  const std::vector<Place> places = places_of(options.devices, precisions);
  const std::vector<ModelAndState> bodies = bodies_of_all_sizes(options.quick);
  ForcesResult result;
  double done = 0;
  for (const Place& place : places) {
    ForcesAt here(place, options);
    for (const ModelAndState& body : bodies) {
      const double part = done++ / static_cast<double>(places.size() * bodies.size());
      if (!result.interrupted) result.interrupted = !measure_size(here, body, name_of(place), part, progress, result.notes);
    }
    const std::vector<ForcesRow> measured = here.rows();
    result.rows.insert(result.rows.end(), measured.begin(), measured.end());
    if (result.interrupted) return result;
  }
  progress(1, "");
  return result;
}

}  // namespace pliant::bench
