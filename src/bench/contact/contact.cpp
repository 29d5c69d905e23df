#include "bench/contact/contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <future>
#include <glm/geometric.hpp>
#include <iterator>
#include <memory>
#include <numeric>
#include <span>
#include <stop_token>
#include <thread>

#include "bench/common/timing.hpp"
#include "bench/contact/cost.hpp"
#include "bench/contact/encounter.hpp"
#include "bench/contact/meeting.hpp"
#include "bench/contact/rest.hpp"
#include "bench/contact/self_cost.hpp"
#include "bench/contact/witness.hpp"
#include "core/error.hpp"
#include "core/larger.hpp"
#include "core/stopwatch.hpp"
#include "dynamics/integrator.hpp"
#include "dynamics/stability.hpp"
#include "mesh/generators.hpp"
#include "mesh/obj.hpp"

namespace pliant::bench {
namespace {

constexpr double apart_omega_step = 0.5;
constexpr std::uint64_t apart_parts = 900, quick_apart_parts = 90;  // watched closely; twice as many for bodies that come fast
constexpr int walks_alone = 4;                                      // whose rounding is compared with that of contacts
constexpr std::size_t many_triangles = 4000;                        // of both bodies
constexpr std::uint32_t few_vertices = 400;                         // of both bodies: more take longer to measure than to move

CollisionDescription by(const char* response, double elasticity = 0.5) {
  return {.response = {response}, .elasticity = elasticity};
}

TimePlan plan_of(const char* integrator, double time_step) {
  return {.integrator = &find_integrator(integrator), .time_step = time_step, .damping_law = DampingLaw::none};
}

struct Task {
  std::string name;
  double cost = 0;                                                                  // about the seconds it takes
  std::function<std::vector<ContactRow>(Device&, const std::stop_token&)> measure;  // ends early if asked to stop
  Place place;
  bool is_timed = false;  // nothing may run beside it
};

bool runs_beside_others(const Task& task) { return task.place.device == DeviceKind::cpu && !task.is_timed; }

// Runs tasks beside each other, the longest first, and returns their rows in the order of the tasks. Asks `goes_on` all the time,
// with the cost of what has begun. A no stops all tasks, and only those that were done by then give rows.
std::vector<ContactRow> run_together(std::span<const Task> tasks, unsigned threads, const std::function<bool(double)>& goes_on) {
  std::vector<std::size_t> order(tasks.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t k) { return tasks[k].cost; });
  std::vector<std::vector<ContactRow>> rows(tasks.size());
  std::atomic<std::size_t> next = 0;
  std::stop_source stop;
  const auto work = [&] {
    for (std::size_t k = next++; k < order.size(); k = next++) {
      const Task& task = tasks[order[k]];
      std::vector<ContactRow> measured = task.measure(*open(task.place), stop.get_token());
      if (stop.stop_requested()) return;
      rows[order[k]] = std::move(measured);
    }
  };
  std::vector<std::future<void>> workers;
  for (unsigned k = 0; k < threads; ++k) workers.push_back(std::async(std::launch::async, work));
  for (std::future<void>& worker : workers)
    while (worker.wait_for(std::chrono::milliseconds(100)) != std::future_status::ready) {
      double begun = 0;
      for (std::size_t k = 0; k < std::min(next.load(), order.size()); ++k) begun += tasks[order[k]].cost;
      if (!goes_on(begun)) stop.request_stop();
    }
  std::vector<ContactRow> all;
  for (std::future<void>& worker : workers) worker.get();
  for (std::vector<ContactRow>& some : rows) std::ranges::move(some, std::back_inserter(all));
  return all;
}

// --- apart

struct Pairing {
  std::string name;
  Partner left, right;
  double far_away = 0;      // from the origin, along each axis [m]
  bool left_comes = false;  // and the right one rests
};

std::size_t triangles_of(const Pairing& pair) { return pair.left.mesh.triangles.size() + pair.right.mesh.triangles.size(); }

// Bodies of large meshes that come fast take most of the time, and a GPU waits for the host's proofs. Both get less. A processor
// would need hours until the fastest of them have parted.
Patience patience_for(const Pairing& pair, double speed, const Place& place, bool quick) {
  const bool is_gpu = place.device == DeviceKind::gpu, is_large = triangles_of(pair) > many_triangles;
  Patience patience{.closely = (speed > 1 ? 2 : 1) * (quick ? quick_apart_parts : apart_parts)};
  if (pair.left.mesh.positions.size() + pair.right.mesh.positions.size() > few_vertices) patience.stride = 16;
  if (quick) return patience;
  if (is_gpu) patience.closely /= 5;
  if (speed > 1 && is_large) patience.closely /= 10;
  if (is_large) patience.to_part = 6000;
  if (speed > 5 && is_large && !is_gpu) patience.to_part = 0;
  return patience;
}

// About the seconds that an encounter takes.
double cost_of(const Pairing& pair, double speed, const Patience& patience) {
  const double parts = static_cast<double>(patience.closely) + (patience.to_part > 0 ? 200 * speed : 0);
  return static_cast<double>(triangles_of(pair)) * parts * 1e-5;
}

ApartRow measure_apart(Device& device, const Pairing& pair, double edges_a_step, const Patience& patience,
                       const std::stop_token& stop) {
  const Meeting meeting = meeting_of(
      pair.left, pair.right,
      {.edges_a_step = edges_a_step, .omega_step = apart_omega_step, .far_away = pair.far_away, .left_comes = pair.left_comes});
  const Model& model = meeting.start.model;
  const std::uint32_t vertices = model.vertex_count();
  const TimePlan plan = plan_of(vertices > 1000 ? "verlet" : "cv8", meeting.time_step);
  Simulation simulation(device, model, meeting.start.state, plan, by("impulse"));
  const SeenEncounter encounter = watch_encounter(simulation, model, patience, stop);
  const Seen& seen = encounter.seen;
  Simulation alone(device, model, seen.most_deformed, plan, by("none"));
  const auto steps_alone = static_cast<std::uint64_t>(std::ceil(seen.report.time / meeting.time_step));
  double changed_alone = 0;
  for (int walk = 0; walk < walks_alone; ++walk)
    changed_alone = larger(changed_alone, most_change_of_momentum(alone, model, steps_alone, stop));
  return {.bodies = pair.name,
          .device = device.info().kind,
          .precision = device.precision(),
          .vertices = vertices,
          .mass_ratio = pair.right.mass / pair.left.mass,
          .radius_ratio = pair.right.radius / pair.left.radius,
          .far_away = pair.far_away,
          .edges_a_step = edges_a_step,
          .omega_step = apart_omega_step,
          .steps = encounter.close_steps,
          .parts = encounter.close_parts,
          .parts_in_all = seen.report.steps + seen.report.substeps,
          .contact_parts = seen.report.contact_steps,
          .cut_vertices = seen.report.reverted_vertices,
          .held_parts = seen.report.held_parts,
          .touching = seen.touching,
          .inside = seen.inside,
          .parted = encounter.parted,
          .broke_down = seen.report.breakdown.has_value(),
          .momentum_change = seen.momentum_change,
          .momentum_change_alone = changed_alone / sum_of_momenta(model, meeting.start.state),
          .angular_momentum_change = seen.angular_momentum_change,
          .most_energy = seen.most_energy,
          .last_energy = seen.last_energy};
}

std::vector<Pairing> pairings(const ContactOptions& options) {
  const auto sphere = [](int level) { return Partner{.mesh = generate_mesh(fmt::format("icosphere:{}", level))}; };
  std::vector<Pairing> all = {{"two spheres", sphere(2), sphere(2)}, {"heavy on light sphere", sphere(2), sphere(2)}};
  all[1].left.mass = 10;
  if (options.quick) return all;
  all.push_back({"two spheres", sphere(3), sphere(3)});
  all.push_back({"two spheres", sphere(4), sphere(4)});
  const auto mesh = [&](const char* name) {
    return Partner{.mesh = load_obj(options.scenes.parent_path() / "meshes" / name).mesh};
  };
  all.push_back({"bunny and sphere", mesh("bunny.obj"), sphere(2)});
  all.push_back({"teapot and bunny", mesh("teapot.obj"), mesh("bunny.obj")});
  return all;
}

std::vector<Place> places(const Selection& selection) {
  std::vector<Place> found;
  if (selection.cpu) found = {{.device = DeviceKind::cpu, .precision = 64}, {.device = DeviceKind::cpu, .precision = 32}};
  if (selection.gpu) found.push_back({.device = DeviceKind::gpu, .precision = 32, .gpu_index = selection.gpu_index});
  return found;
}

void add_apart(std::vector<Task>& tasks, const ContactOptions& options) {
  const std::vector<double> speeds =
      options.quick ? std::vector{0.05, 0.5, 4.0} : std::vector{0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 60.0};
  for (const Pairing& pair : pairings(options))
    for (const Place& place : places(options.devices))
      for (const double speed : speeds) {
        const Patience patience = patience_for(pair, speed, place, options.quick);
        tasks.push_back({fmt::format("apart, {}, {} edges a step, {}", pair.name, speed, name_of(place)),
                         cost_of(pair, speed, patience),
                         [=](Device& device, const std::stop_token& stop) {
                           return std::vector<ContactRow>{measure_apart(device, pair, speed, patience, stop)};
                         },
                         place});
      }
}

// --- extremes

// One of them, by the second sphere's mass and radius over the first one's. The heavy sphere hits one that rests.
std::vector<Pairing> extremes() {
  const Partner sphere{.mesh = generate_mesh("icosphere:2")};
  std::vector<Pairing> all;
  for (const double mass : {10.0, 1e3, 1e6}) {
    all.push_back({fmt::format("mass {:g} on resting", mass), sphere, sphere, 0, true});
    all.back().left.mass = mass;
  }
  for (const double radius : {1e-1, 1e-2, 1e-3}) {
    all.push_back({fmt::format("radius {:g}", radius), sphere, sphere});
    all.back().right.radius = radius;
  }
  for (const double far_away : {1e2, 1e4}) all.push_back({fmt::format("{:g} m away", far_away), sphere, sphere, far_away});
  return all;
}

void add_extremes(std::vector<Task>& tasks, const ContactOptions& options) {
  const Patience patience{.closely = 400};
  const std::vector<double> speeds = options.quick ? std::vector{0.2} : std::vector{0.05, 0.1, 0.2, 0.25};
  for (const Pairing& pair : extremes())
    for (const Place& place : places(options.devices))
      for (const double speed : speeds)
        tasks.push_back({fmt::format("extremes, {}, {} edges a step, {}", pair.name, speed, name_of(place)), 1,
                         [=](Device& device, const std::stop_token& stop) {
                           return std::vector<ContactRow>{measure_apart(device, pair, speed, patience, stop)};
                         },
                         place});
}

// --- rest

void add_rest(std::vector<Task>& tasks, const ContactOptions& options) {
  const RestWatch how = options.quick ? RestWatch{.settling = 1500, .watched = 100} : RestWatch{};
  for (const RestingPlace& resting : resting_places())
    for (const Place& place : places(options.devices))
      tasks.push_back({fmt::format("rest, {}, {}", resting.name, name_of(place)), options.quick ? 1.0 : 8.0,
                       [=](Device& device, const std::stop_token& stop) {
                         const RestSeen seen =
                             watch_rest(device, resting, {.settling = how.settling, .watched = how.watched, .stop = stop});
                         return std::vector<ContactRow>{RestRow{.bodies = resting.name,
                                                                .device = device.info().kind,
                                                                .precision = device.precision(),
                                                                .steps = how.watched,
                                                                .contacts = seen.contacts,
                                                                .cut_vertices = seen.cut_vertices,
                                                                .most_a_step = seen.most_a_step,
                                                                .drift = seen.drift}};
                       },
                       place});
}

// --- impacts

struct Impact {
  const char* response;
  const char* integrator;
  double stiffness = 1e3;
  double elasticity = 0.5;
};

// What an impact gives.
struct Outcome {
  glm::dvec3 centre{0.0}, momentum{0.0}, spin{0.0};  // of the first body [m], [kg m/s], [kg m^2/s]
};

Outcome outcome_of(const Model& model, const State& state) {
  const std::vector<glm::dvec3> positions = state.world_positions(model), velocities = state.world_velocities(model);
  const ModelBody& body = model.bodies[0];
  const double mass = body.vertex_mass, n = body.vertex_count;
  Outcome found;
  for (std::uint32_t i = 0; i < body.vertex_count; ++i) {
    found.centre += positions[i] / n;
    found.momentum += mass * velocities[i];
  }
  for (std::uint32_t i = 0; i < body.vertex_count; ++i)
    found.spin += mass * glm::cross(positions[i] - found.centre, velocities[i]);
  return found;
}

constexpr double impact_speed = 2;         // against each other [m/s]
constexpr double impact_omega_time = 120;  // duration times the softest bodies' stiffest frequency

Meeting impact_meeting(const Impact& impact) {
  const Partner sphere{.mesh = generate_mesh("icosphere:2"), .stiffness = impact.stiffness};
  Meeting meeting = meeting_of(sphere, sphere, {.edges_a_step = 1, .distance = 1});
  return meeting_of(sphere, sphere, {.edges_a_step = impact_speed / meeting.speed, .distance = 1});
}

ImpactRow measure_impact(Device& device, const Impact& impact, double omega_step, Outcome& outcome, const std::stop_token& stop) {
  const Meeting meeting = impact_meeting(impact);
  const ModelAndState& start = meeting.start;
  const double omega = stiffest_frequency(start.model.bodies[0]), duration = impact_omega_time / std::sqrt(1e3);
  const double steps = std::ceil(duration * omega / omega_step);
  Simulation simulation(device, start.model, start.state, plan_of(impact.integrator, duration / steps),
                        by(impact.response, impact.elasticity));
  Witness witness(start);
  for (double made = 0; made < steps && !stop.stop_requested(); made += 8) {
    simulation.advance(static_cast<std::uint64_t>(std::min(8.0, steps - made)));
    witness.look_at_motion(simulation.state());
  }
  outcome = outcome_of(start.model, simulation.state());
  const double before = outcome_of(start.model, start.state).momentum.x;
  return {.response = impact.response,
          .integrator = impact.integrator,
          .stiffness = impact.stiffness,
          .elasticity = impact.elasticity,
          .omega_step = duration / steps * omega,
          .kept = -outcome.momentum.x / before,
          .most_energy = witness.seen.most_energy,
          .position_error = {},
          .momentum_error = {},
          .spin_error = {}};
}

std::vector<ContactRow> measure_sweep(Device& device, const Impact& impact, const std::vector<double>& omega_steps,
                                      const std::stop_token& stop) {
  std::vector<ImpactRow> rows;
  std::vector<Outcome> outcomes;
  for (const double omega_step : omega_steps)
    rows.push_back(measure_impact(device, impact, omega_step, outcomes.emplace_back(), stop));
  const Outcome& exact = outcomes.back();
  const double momentum = impact_speed / 2;  // of a body of 1 kg, which is its angular momentum at 1 m, too
  for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
    rows[k].position_error = glm::length(outcomes[k].centre - exact.centre);
    rows[k].momentum_error = glm::length(outcomes[k].momentum - exact.momentum) / momentum;
    rows[k].spin_error = glm::length(outcomes[k].spin - exact.spin) / momentum;
  }
  return {rows.begin(), rows.end()};
}

void add_impacts(std::vector<Task>& tasks, const ContactOptions& options) {
  if (!options.devices.cpu) return;
  const Place place{.device = DeviceKind::cpu, .precision = 64};
  std::vector<double> halved;
  for (double omega_step = 0.8; halved.size() < (options.quick ? 3 : 9); omega_step /= 2) halved.push_back(omega_step);
  const auto add = [&](const Impact& impact, const std::vector<double>& steps) {
    tasks.push_back({fmt::format("impact, {}, {}, N k = {:g}, e = {}", impact.response, impact.integrator, impact.stiffness,
                                 impact.elasticity),
                     0.2 * std::sqrt(impact.stiffness / 1e3) / steps.back(),
                     [=](Device& device, const std::stop_token& stop) { return measure_sweep(device, impact, steps, stop); },
                     place});
  };
  for (const char* integrator : {"verlet", "cv8"})
    for (const char* response : {"impulse", "reflect"}) add({response, integrator}, halved);
  for (const double stiffness : {1e3, 1e4, 1e5})
    for (const double elasticity : {0.0, 0.5, 1.0})
      if (!options.quick || stiffness == 1e3) add({"impulse", "cv8", stiffness, elasticity}, {0.3});
}

// --- cost

void add_costs(std::vector<Task>& tasks, const ContactOptions& options) {
  for (const Place& place : places(options.devices))
    for (const int level : {2, 3, 4})
      for (const double speed : {0.05, 0.5, 1.0})
        if (place.precision == 32 && (!options.quick || level == 2))
          tasks.push_back({fmt::format("cost, icosphere:{}, {}", level, name_of(place)), 0.05 * std::pow(16, level - 2),
                           [=](Device& device, const std::stop_token&) {
                             return std::vector<ContactRow>{measure_cost(device, level, speed)};
                           },
                           place, true});
}

// Spheres are stars. A ring is none, so that its tree is compared with itself.
void add_self_costs(std::vector<Task>& tasks, const ContactOptions& options) {
  for (const char* mesh : {"icosphere:2", "icosphere:3", "icosphere:4", "ring:0.3,16", "ring:0.3,32", "ring:0.3,64"}) {
    const double vertices = static_cast<double>(generate_mesh(mesh).positions.size());
    if (options.quick && vertices > 300) continue;
    for (const Place& place : places(options.devices))
      for (const bool rests : {false, true})
        if (place.precision == 32)
          tasks.push_back({fmt::format("self-contact, {} {}, {}", mesh, rests ? "rests" : "flies", name_of(place)),
                           0.5 + 2e-6 * vertices * vertices,
                           [=](Device& device, const std::stop_token&) {
                             return std::vector<ContactRow>{measure_self_cost(device, mesh, rests)};
                           },
                           place, true});
  }
}

// --- all

std::vector<std::string> notes_of(const std::vector<ContactRow>& rows) {
  std::uint64_t steps = 0, parts = 0, touching = 0, inside = 0, without_contact = 0, not_parted = 0, broke_down = 0;
  std::vector<double> ratios;  // of changes of momentum in fp32, with contacts and alone
  for (const ContactRow& any : rows)
    if (const auto* row = std::get_if<ApartRow>(&any)) {
      steps += row->steps;
      parts += row->parts;
      touching += row->touching;
      inside += row->inside;
      without_contact += row->contact_parts == 0 ? 1 : 0;
      not_parted += row->parted ? 0 : 1;
      broke_down += row->broke_down ? 1 : 0;
      if (row->precision == 32 && row->momentum_change_alone > 0)
        ratios.push_back(row->momentum_change / row->momentum_change_alone);
    }
  if (steps == 0) return {};
  std::ranges::sort(ratios);
  std::vector<std::string> notes = {
      fmt::format("apart: {} steps in {} parts: {} pairs of triangles not apart, {} vertices inside another body", steps, parts,
                  touching, inside),
      fmt::format("apart: {} cases without contact, {} in which bodies have not parted by the end", without_contact, not_parted)};
  if (broke_down > 0) notes.push_back(fmt::format("apart: {} cases broke down", broke_down));
  if (!ratios.empty())
    notes.push_back(
        fmt::format("apart: in fp32 momentum changes by {:.2f} times as much as without contacts (median), at most {:.2f}",
                    ratios[ratios.size() / 2], ratios.back()));
  return notes;
}

}  // namespace

ContactResult bench_contact(const ContactOptions& options, const Progress& progress) {
  std::vector<Task> tasks;
  const auto is_asked = [&](ContactStudy study) { return !options.only || *options.only == study; };
  if (is_asked(ContactStudy::apart)) add_apart(tasks, options);
  if (is_asked(ContactStudy::apart)) add_extremes(tasks, options);
  if (is_asked(ContactStudy::rest)) add_rest(tasks, options);
  if (is_asked(ContactStudy::impacts)) add_impacts(tasks, options);
  if (is_asked(ContactStudy::cost)) add_costs(tasks, options);
  if (is_asked(ContactStudy::self)) add_self_costs(tasks, options);
  if (tasks.empty())
    throw Error(ErrorKind::command_line, "--only", "impacts are measured on the CPU alone", "use --device cpu or all");
  const auto alone = std::ranges::stable_partition(tasks, runs_beside_others);
  std::ranges::stable_sort(alone, {}, &Task::cost);  // so that a run that ends early has measured the most
  const auto on_gpu = std::ranges::find(tasks, DeviceKind::gpu, [](const Task& task) { return task.place.device; });
  if (on_gpu != tasks.end()) static_cast<void>(open(on_gpu->place));  // throws before anything is measured
  double total = 0, done = 0;
  for (const Task& task : tasks) total += task.cost;
  ContactResult result;
  const auto goes_on = [&](double begun, const std::string& name) {
    result.interrupted = result.interrupted || !progress((done + begun) / total, name);
    return !result.interrupted;
  };
  const std::span<const Task> together(tasks.begin(), alone.begin());
  const unsigned threads = options.devices.threads != 0 ? options.devices.threads : std::thread::hardware_concurrency();
  result.rows = run_together(together, threads, [&](double begun) { return goes_on(begun, "on the CPU"); });
  for (const Task& task : together) done += task.cost;
  for (const Task& task : alone) {
    if (result.interrupted) break;
    std::ranges::move(run_together({&task, 1}, 1, [&](double begun) { return goes_on(begun, task.name); }),
                      std::back_inserter(result.rows));
    done += task.cost;
  }
  if (!result.interrupted) progress(1, "");
  result.notes = notes_of(result.rows);
  return result;
}

}  // namespace pliant::bench
