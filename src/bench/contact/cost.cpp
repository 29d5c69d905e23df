#include "bench/contact/cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "bench/common/timing.hpp"
#include "bench/contact/meeting.hpp"
#include "core/stopwatch.hpp"
#include "dynamics/integrator.hpp"
#include "mesh/generators.hpp"
#include "simulation/simulation.hpp"

namespace pliant::bench {
namespace {

constexpr std::uint64_t parts_of_a_window = 16;
constexpr std::size_t most_windows = 100;
constexpr double warming_time = 0.3;  // [s]; a GPU's clocks rise under load
constexpr double far_apart = 1e5;     // edges: spheres do not meet while they are watched
constexpr double stretched = 1.01;    // along an axis, so that no force is left out because it is zero

// So many parts of steps, in a row.
struct Window {
  double seconds = 0;        // a part
  std::size_t contacts = 0;  // impulses in its last part
};

class Spheres {
 public:
  Spheres(Device& device, int level, double edges_a_step, double distance, const char* response)
      : device_(device),
        meeting_(meeting_of(sphere_of(level), sphere_of(level),
                            {.edges_a_step = edges_a_step, .omega_step = 0.3, .distance = distance, .stretch = stretched})),
        simulation_(device, meeting_.start.model, meeting_.start.state,
                    {.integrator = &find_integrator("verlet"), .time_step = meeting_.time_step, .damping_law = DampingLaw::none},
                    {.response = {response}, .elasticity = 0.5}) {}

  Window watch() {
    Stopwatch stopwatch;
    stopwatch.time([&] {
      for (std::uint64_t part = 0; part < parts_of_a_window; ++part) simulation_.advance_part();
      device_.finish();
    });
    return {.seconds = stopwatch.seconds() / static_cast<double>(parts_of_a_window),
            .contacts = simulation_.contact_impulses().size()};
  }

  // From the start until they part again, but no more than so many windows.
  std::vector<Window> watch_all() {
    std::vector<Window> windows;
    do windows.push_back(watch());
    while (windows.size() < most_windows && !(windows.back().contacts == 0 && most_contacts(windows) > 0));
    return windows;
  }

  static std::size_t most_contacts(const std::vector<Window>& windows) {
    return std::ranges::max(windows, {}, &Window::contacts).contacts;
  }

 private:
  static Partner sphere_of(int level) { return {.mesh = generate_mesh(fmt::format("icosphere:{}", level))}; }

  Device& device_;
  Meeting meeting_;
  Simulation simulation_;
};

double median_microseconds(const std::vector<Window>& windows, std::size_t fewest_contacts) {
  std::vector<double> microseconds;
  for (const Window& window : windows)
    if (window.contacts >= fewest_contacts) microseconds.push_back(1e6 * window.seconds);
  return median(std::move(microseconds));
}

// A driver may replace kernels while they run, which takes seconds. So this waits for windows that take the same.
void warm_up(Spheres& spheres) {
  Stopwatch warming;
  double before = 0, latest = 0;
  do {
    before = latest;
    warming.time([&] { latest = spheres.watch().seconds; });
  } while (warming.seconds() < warming_time ||
           (std::abs(latest - before) > 0.1 * before && warming.seconds() < 10 * warming_time));
}

// Of steps in which spheres are far apart.
double microseconds_in_flight(Device& device, int level, double edges_a_step, const char* response) {
  Spheres spheres(device, level, edges_a_step, far_apart, response);
  warm_up(spheres);
  std::vector<Window> windows;
  for (int k = 0; k < 9; ++k) windows.push_back(spheres.watch());
  return median_microseconds(windows, 0);
}

}  // namespace

CostRow measure_cost(Device& device, int level, double edges_a_step) {
  CostRow row{.device = device.info().kind,
              .precision = device.precision(),
              .vertices = generate_mesh(fmt::format("icosphere:{}", level)).positions.size(),
              .edges_a_step = edges_a_step};
  row.microseconds_without = microseconds_in_flight(device, level, edges_a_step, "none");
  row.microseconds_apart = microseconds_in_flight(device, level, edges_a_step, "impulse");
  const std::vector<Window> windows = Spheres(device, level, edges_a_step, 0.5, "impulse").watch_all();
  row.contacts = Spheres::most_contacts(windows);
  row.microseconds = median_microseconds(windows, 3 * row.contacts / 4);
  return row;
}

}  // namespace pliant::bench
