#include "python/simulation.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "model/place_body.hpp"
#include "python/arrays.hpp"
#include "run/driven_run.hpp"

namespace pliant::python {
namespace {

// Several Python threads may share a simulation: calls wait for each other, and let other threads run meanwhile. A Ctrl-C ends
// steps early.
class SharedRun {
 public:
  explicit SharedRun(const RunOptions& options) : run_(std::make_unique<DrivenRun>(options)) {}
  // Where another thread than its own drops the last reference, the run stays in memory.
  ~SharedRun() {
    if (run_->is_of_another_thread()) static_cast<void>(run_.release());
  }
  SharedRun(const SharedRun&) = delete;
  SharedRun& operator=(const SharedRun&) = delete;

  /// Returns what `use` makes of the run, while Python goes on.
  template <class Use>
  auto with(const Use& use) {
    const py::gil_scoped_release others_run;
    const std::lock_guard alone(mutex_);
    return use(*run_);
  }

  /// Steps by `step`, which is given what to ask for an early end. Throws what a signal's handler raises.
  template <class Step>
  bool step(const Step& step) {
    bool is_interrupted = false;
    const DrivenRun::Stops stops = [&] {
      const py::gil_scoped_acquire python;
      return is_interrupted = is_interrupted || PyErr_CheckSignals() != 0;
    };
    const bool is_broken = with([&](DrivenRun& run) {
      step(run, stops);
      return run.has_broken_down();
    });
    if (is_interrupted) throw py::error_already_set();
    return is_broken;
  }

  /// Queues a step. Returns whether numbers are known to have gone wrong. A GPU is asked now and then, because it has to be
  /// waited for.
  bool step_once() {
    return with([&](DrivenRun& run) {
      run.advance(1);
      if (run.device().info().kind == DeviceKind::gpu && ++steps_unlooked_ % looks_every != 0) return false;
      return run.has_broken_down();
    });
  }

 private:
  static constexpr unsigned looks_every = 32;

  std::unique_ptr<DrivenRun> run_;
  std::mutex mutex_;
  unsigned steps_unlooked_ = 0;
};

// The package has checked the word: auto, cpu, gpu, or gpu:N.
DeviceChoice device_of(const std::string& word) {
  if (word == "auto") return {};
  if (word == "cpu") return {.wish = DeviceWish::cpu, .gpu_index = {}, .precision = {}};
  DeviceChoice gpu{.wish = DeviceWish::gpu, .gpu_index = {}, .precision = {}};
  if (word.size() > 4) gpu.gpu_index = std::stoi(word.substr(4));
  return gpu;
}

using MeshArrays = std::map<std::string, std::pair<Rows<double>, Rows<std::int64_t>>>;

std::unique_ptr<SharedRun> make(const std::string& text, const std::string& file, const std::vector<std::string>& overrides,
                                const MeshArrays& meshes, const std::string& device, std::optional<int> precision,
                                unsigned threads) {
  RunOptions options;
  options.scene = file;
  options.scene_text = text;
  options.overrides = overrides;
  options.quiet = true;
  options.device = device_of(device);
  options.device.precision = precision;
  options.device.threads = threads;
  for (const auto& [name, arrays] : meshes) options.meshes[name] = mesh_of(arrays.first, arrays.second);
  const py::gil_scoped_release others_run;
  return std::make_unique<SharedRun>(options);
}

py::list bodies_of(SharedRun& shared) {
  const std::vector<ModelBody> bodies = shared.with([](DrivenRun& run) { return run.model().bodies; });
  const char* kinds[] = {"soft", "static", "scripted"};
  py::list told;
  for (const ModelBody& body : bodies) {
    py::dict of;
    of["name"] = body.name;
    of["kind"] = kinds[static_cast<int>(body.kind)];
    of["vertices"] = py::slice(body.first_vertex, body.first_vertex + body.vertex_count, 1);
    of["triangles"] = py::slice(body.first_triangle, body.first_triangle + body.triangle_count, 1);
    of["stiffness"] = body.stiffness;
    of["vertex_mass"] = body.vertex_mass;
    of["damping"] = body.damping;
    of["radius"] = body.radius;
    told.append(of);
  }
  return told;
}

py::dict plan_of(SharedRun& shared) {
  return shared.with([](DrivenRun& run) {
    const py::gil_scoped_acquire python;
    const TimePlan& plan = run.plan();
    py::dict told;
    told["integrator"] = std::string(plan.integrator->name);
    told["time_step"] = plan.tolerance ? py::object(py::none()) : py::float_(plan.time_step);
    told["step_bound"] = plan.step_bound;
    told["duration"] = run.scene().simulation.duration;
    told["vertices"] = run.model().vertex_count();
    told["device"] = run.device().info().name;
    told["precision"] = run.device().precision();
    told["warnings"] = run.warnings();
    return told;
  });
}

py::dict told_breakdown(const Breakdown& breakdown, const Model& model) {
  py::dict told;
  told["step"] = breakdown.step;
  told["body"] = model.bodies[breakdown.body].name;
  told["vertex"] = breakdown.vertex;
  told["is_finite"] = breakdown.is_finite;
  told["takes_too_many"] = breakdown.takes_too_many;
  return told;
}

py::dict told_response(const ResponseReport& response, const Model& model) {
  py::dict told;
  told["outside_impulse"] = py::make_tuple(response.outside_impulse.x, response.outside_impulse.y, response.outside_impulse.z);
  told["energy_given"] = response.energy_given;
  told["energy_taken"] = response.energy_taken;
  told["friction_work"] = response.friction_work;
  told["work_of_scripts"] = response.work_of_scripts;
  py::dict scripts;
  for (const ScriptReport& script : response.scripts) {
    py::dict of;
    of["time"] = script.time;
    of["waited"] = script.waited;
    of["waits"] = script.waits;
    scripts[model.bodies[script.body].name.c_str()] = of;
  }
  told["scripts"] = scripts;
  return told;
}

py::object told_clusters(const std::optional<ClusterReport>& clusters, const Model& model) {
  if (!clusters) return py::none();
  py::dict told;
  told["checks"] = clusters->checks;
  told["largest_error"] = clusters->largest_error;
  told["lists_made"] = clusters->lists_made;
  py::list direct;
  for (const std::uint32_t body : clusters->direct) direct.append(model.bodies[body].name);
  told["direct"] = direct;
  return told;
}

py::object told_adaptive(const std::optional<AdaptiveReport>& adaptive) {
  if (!adaptive) return py::none();
  py::dict told;
  told["rejected"] = adaptive->rejected;
  told["rejected_in_contact"] = adaptive->rejected_in_contact;
  told["smallest_step"] = adaptive->smallest_step;
  told["largest_step"] = adaptive->largest_step;
  told["next_step"] = adaptive->next_step;
  return told;
}

py::dict told_report(const StepReport& report, const Model& model) {
  py::dict told;
  told["steps"] = report.steps;
  told["time"] = report.time;
  told["adaptive"] = told_adaptive(report.adaptive);
  told["breakdown"] = report.breakdown ? py::object(told_breakdown(*report.breakdown, model)) : py::none();
  told["contact_steps"] = report.contact_steps;
  told["contact_pairs_max"] = report.contact_pairs_max;
  told["reverted_vertices"] = report.reverted_vertices;
  told["substeps"] = report.substeps;
  told["held_parts"] = report.held_parts;
  told["unsettled_contacts"] = report.unsettled_contacts;
  told["contacts"] = told_response(report.response, model);
  told["clusters"] = told_clusters(report.clusters, model);
  told["force_evaluations"] = report.force_evaluations;
  told["pair_interactions"] = report.pair_interactions;
  told["nodes_refitted"] = report.nodes_refitted;
  told["node_tests"] = report.node_tests;
  told["triangle_tests"] = report.triangle_tests;
  told["quiet_steps"] = report.quiet_steps;
  told["frame_changes"] = report.frame_changes;
  told["forces_skipped"] = report.forces_skipped;
  told["steps_at_rest"] = report.steps_at_rest;
  told["steps_asleep"] = report.steps_asleep;
  told["bodies_asleep"] = report.bodies_asleep;
  told["energy_slept"] = report.energy_slept;
  told["body_pairs_skipped"] = report.body_pairs_skipped;
  told["refits_skipped"] = report.refits_skipped;
  return told;
}

py::dict report_of(SharedRun& shared) {
  return shared.with([](DrivenRun& run) {
    const StepReport report = run.report();
    const py::gil_scoped_acquire python;
    return told_report(report, run.model());
  });
}

std::uint32_t vertices_of(SharedRun& shared) {
  return shared.with([](DrivenRun& run) { return run.model().vertex_count(); });
}

// `out` is contiguous, writable and of the shape (vertices, 3). The package made it, or checked it.
void read_positions(SharedRun& shared, py::array_t<double, py::array::c_style> out) {
  const std::span<glm::dvec3> to = vectors_in(out);
  shared.with([&](DrivenRun& run) { run.state().read_world_positions(run.model(), to); });
}

py::array_t<double> velocities_of(SharedRun& shared) {
  py::array_t<double, py::array::c_style> velocities({static_cast<py::ssize_t>(vertices_of(shared)), py::ssize_t{3}});
  const std::span<glm::dvec3> to = vectors_in(velocities);
  shared.with([&](DrivenRun& run) { run.state().read_world_velocities(run.model(), to); });
  return velocities;
}

// As the device has them: rows of four numbers.
py::array_t<float> drawn_positions_of(SharedRun& shared) {
  py::array_t<float> positions({static_cast<py::ssize_t>(vertices_of(shared)), py::ssize_t{4}});
  const std::span<glm::vec4> to(reinterpret_cast<glm::vec4*>(positions.mutable_data()),
                                static_cast<std::size_t>(positions.shape(0)));
  shared.with([&](DrivenRun& run) { run.simulation().read_world_positions(to); });
  return positions;
}

py::dict measure(SharedRun& shared) {
  const Measurement measured = shared.with([](DrivenRun& run) { return run.measure(); });
  py::dict told;
  told["kinetic"] = measured.kinetic;
  told["elastic"] = measured.elastic;
  told["gravitational"] = measured.gravitational;
  told["momentum"] = array_of(measured.momentum);
  told["angular_momentum"] = array_of(measured.angular_momentum);
  return told;
}

py::tuple contacts_of(SharedRun& shared) {
  const auto contacts = shared.with([](DrivenRun& run) { return run.simulation().contact_impulses(); });
  const auto count = static_cast<py::ssize_t>(contacts.size());
  py::array_t<std::int64_t> vertices({count, py::ssize_t{4}});
  py::array_t<double> weights({count, py::ssize_t{4}}), impulses({count, py::ssize_t{3}});
  for (py::ssize_t c = 0; c < count; ++c) {
    const ContactImpulse& contact = contacts[static_cast<std::size_t>(c)];
    for (int k = 0; k < 4; ++k) {
      const bool is_missing = contact.vertex[k] == physics::no_vertex;
      vertices.mutable_at(c, k) = is_missing ? -1 : std::int64_t{contact.vertex[k]};
      weights.mutable_at(c, k) = is_missing ? 0 : contact.weight[k];
    }
    for (int k = 0; k < 3; ++k) impulses.mutable_at(c, k) = contact.impulse[k];
  }
  return py::make_tuple(vertices, weights, impulses);
}

py::tuple intersections_of(SharedRun& shared) {
  const Intersections found = shared.with([](DrivenRun& run) { return run.simulation().intersections(); });
  const auto bodies = shared.with([](DrivenRun& run) { return run.model().bodies; });
  py::list names;
  for (const std::uint32_t body : found.bodies) names.append(bodies[body].name);
  return py::make_tuple(found.pairs, names);
}

constexpr double most = 1e9;  // as build_model() allows [m], [m/s]

void expect_within_reach(std::span<const glm::dvec3> vectors, const char* name) {
  for (std::size_t i = 0; i < vectors.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (!(std::abs(vectors[i][k]) <= most))
        throw Error(ErrorKind::input, name, fmt::format("row {} has the number {}", i, vectors[i][k]),
                    "use finite numbers up to 1e9");
}

// Changes rows of bodies by `change`, which is given a body and its rows. What is none keeps all.
template <class Change>
void change_rows(const std::optional<Rows<double>>& rows, const char* name, const Model& model, const State& state,
                 glm::dvec3 (State::*now)(const Model&, std::size_t) const, const Change& change) {
  if (!rows) return;
  const auto vectors = vectors_of(*rows);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const ModelBody& body = model.bodies[b];
    const auto own = vectors.subspan(body.first_vertex, body.vertex_count);
    const auto is_same = [&, i = body.first_vertex](const glm::dvec3& v) mutable { return (state.*now)(model, i++) == v; };
    if (std::ranges::all_of(own, is_same)) continue;
    if (body.is_rigid())
      throw Error(ErrorKind::input, name, "body \"" + body.name + "\" keeps its place, because it is static or scripted",
                  "leave its rows as they are");
    change(b, own);
  }
}

void set_state(SharedRun& shared, const std::optional<Rows<double>>& positions, const std::optional<Rows<double>>& velocities) {
  const auto expect = [&](const std::optional<Rows<double>>& rows, const char* name) {
    if (!rows) return;
    expect_shape(*rows, vertices_of(shared), 3, name);
    expect_within_reach(vectors_of(*rows), name);
  };
  expect(positions, "positions");
  expect(velocities, "velocities");
  shared.with([&](DrivenRun& run) {
    const Model& model = run.model();
    const State before = run.state();
    State state = before;
    change_rows(positions, "positions", model, before, &State::world_position,
                [&](std::size_t b, auto rows) { place_body(state, model, b, rows, run.scene().simulation.gravity); });
    change_rows(velocities, "velocities", model, before, &State::world_velocity,
                [&](std::size_t b, auto rows) { set_velocities(state, model, b, rows); });
    run.go_on_with(state);
  });
}

void set_materials(SharedRun& shared, const Rows<double>& rows) {
  std::vector<Material> materials;
  for (const glm::dvec3& row : vectors_of(rows)) materials.push_back({row.x, row.y, row.z});
  shared.with([&](DrivenRun& run) { run.go_on_with(materials); });
}

py::array_t<std::uint8_t> render(SharedRun& shared, std::optional<std::array<std::uint32_t, 2>> size,
                                 std::optional<std::array<double, 7>> camera, std::optional<bool> by_strain,
                                 std::optional<bool> shows_contacts) {
  const render::Image image = shared.with([&](DrivenRun& run) {
    OutputDescription output = run.scene().output;
    if (size) output.size = {(*size)[0], (*size)[1]};
    if (camera) {
      const auto& c = *camera;
      output.camera = CameraDescription{.eye = {c[0], c[1], c[2]}, .target = {c[3], c[4], c[5]}, .field_of_view = c[6]};
    }
    if (by_strain) output.coloring = *by_strain ? Coloring::deformation : Coloring::body;
    if (shows_contacts) output.marks = *shows_contacts ? Marks::contacts : Marks::none;
    return run.render(output);
  });
  py::array_t<std::uint8_t> pixels({py::ssize_t{image.height}, py::ssize_t{image.width}, py::ssize_t{3}});
  std::ranges::copy(image.pixels, pixels.mutable_data());
  return pixels;
}

}  // namespace

void define_simulation(py::module_& module) {
  const auto advance = [](SharedRun& shared, std::uint64_t steps) {
    if (steps == 1) return shared.step_once();
    return shared.step([steps](DrivenRun& run, const DrivenRun::Stops& stops) { run.advance(steps, stops); });
  };
  const auto advance_to = [](SharedRun& shared, double time) {
    return shared.step([time](DrivenRun& run, const DrivenRun::Stops& stops) { run.advance_to(time, stops); });
  };
  const auto triangles = [](SharedRun& shared) {
    return array_of(shared.with([](DrivenRun& run) { return run.model().triangles; }));
  };
  const auto time = [](SharedRun& shared) { return shared.with([](DrivenRun& run) { return run.report().time; }); };
  const auto steps = [](SharedRun& shared) { return shared.with([](DrivenRun& run) { return run.report().steps; }); };
  const auto touching = [](SharedRun& shared) {
    const auto found = shared.with([](DrivenRun& run) { return run.simulation().touching_vertices(); });
    return py::array_t<std::uint32_t>(static_cast<py::ssize_t>(found.size()), found.data());
  };
  const auto pull = [](SharedRun& shared, std::uint32_t vertex, const std::array<double, 3>& target, double seconds) {
    shared.with([&](DrivenRun& run) { run.pull({vertex, {target[0], target[1], target[2]}}, seconds); });
  };
  const auto send = [](SharedRun& shared, std::uint32_t body, const std::array<double, 3>& target, double seconds) {
    shared.with([&](DrivenRun& run) { run.send(body, {target[0], target[1], target[2]}, seconds); });
  };
  const auto save = [](SharedRun& shared) { return py::bytes(shared.with([](DrivenRun& run) { return run.save(); })); };
  const auto restore = [](SharedRun& shared, const py::bytes& saved) {
    const std::string_view bytes = saved;
    shared.with([&](DrivenRun& run) { run.restore(bytes); });
  };
  py::class_<SharedRun>(module, "Simulation")
      .def(py::init(&make), py::arg("text"), py::arg("file"), py::arg("overrides"), py::arg("meshes"), py::arg("device"),
           py::arg("precision"), py::arg("threads"))
      .def("advance", advance, py::arg("steps"))
      .def("advance_to", advance_to, py::arg("time"))
      .def("plan", &plan_of)
      .def("bodies", &bodies_of)
      .def("triangles", triangles)
      .def("time", time)
      .def("steps", steps)
      .def("report", &report_of)
      .def("read_positions", &read_positions, py::arg("out"))
      .def("velocities", &velocities_of)
      .def("drawn_positions", &drawn_positions_of)
      .def("measure", &measure)
      .def("contacts", &contacts_of)
      .def("touching_vertices", touching)
      .def("intersections", &intersections_of)
      .def("set_state", &set_state, py::arg("positions"), py::arg("velocities"))
      .def("set_materials", &set_materials, py::arg("rows"))
      .def("pull", pull, py::arg("vertex"), py::arg("target"), py::arg("seconds"))
      .def("send", send, py::arg("body"), py::arg("target"), py::arg("seconds"))
      .def("save", save)
      .def("restore", restore, py::arg("saved"))
      .def("render", &render, py::arg("size"), py::arg("camera"), py::arg("by_strain"), py::arg("shows_contacts"));
}

}  // namespace pliant::python
