// The module pliant._core: what the Python package needs of the library. Users call the package (python/pliant), which documents
// shapes, units and errors.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>
#include <filesystem>
#include <utility>

#include "core/error.hpp"
#include "core/read_text.hpp"
#include "core/version.hpp"
#include "mesh/expect_mesh.hpp"
#include "mesh/load.hpp"
#include "mesh/report.hpp"
#include "mesh/subdivide.hpp"
#include "output/mesh_file.hpp"
#include "python/arrays.hpp"
#include "python/simulation.hpp"
#include "run/info.hpp"
#include "scene/load_scene.hpp"

namespace pliant::python {

TriangleMesh mesh_of(const Rows<double>& positions, const Rows<std::int64_t>& triangles) {
  expect_shape(positions, -1, 3, "positions");
  expect_shape(triangles, -1, 3, "triangles");
  TriangleMesh mesh;
  const auto vectors = vectors_of(positions);
  mesh.positions.assign(vectors.begin(), vectors.end());
  const std::int64_t* numbers = triangles.data();
  for (py::ssize_t t = 0; t < triangles.shape(0); ++t)
    for (std::size_t k = 0; k < 3; ++k, ++numbers) {
      if (*numbers < 0 || *numbers > 0xfffffffe)
        throw Error(ErrorKind::input, "triangles", "triangle " + std::to_string(t) + " names vertex " + std::to_string(*numbers),
                    "count vertices from 0");
      if (k == 0) mesh.triangles.emplace_back();
      mesh.triangles.back()[k] = static_cast<std::uint32_t>(*numbers);
    }
  expect_mesh(mesh);
  return mesh;
}

namespace {

// Errors become those of pliant.errors.
void raise_error(std::exception_ptr thrown) {
  if (!thrown) return;
  try {
    std::rethrow_exception(thrown);
  } catch (const Error& error) {
    const char* kinds[] = {"command_line", "input", "device"};
    const auto kind = static_cast<std::size_t>(error.kind()) - static_cast<std::size_t>(ErrorKind::command_line);
    const py::object raised =
        py::module_::import("pliant.errors").attr("_from_core")(kinds[kind], error.place(), error.problem(), error.remedy());
    PyErr_SetObject(py::type::of(raised).ptr(), raised.ptr());
  }
}

py::tuple arrays_of(const TriangleMesh& mesh) {
  return py::make_tuple(array_of(mesh.positions), array_of(std::span<const std::array<std::uint32_t, 3>>(mesh.triangles)));
}

py::tuple load(const std::string& description, const std::string& folder) {
  const LoadedMesh loaded = load_mesh(description, folder);
  return py::make_tuple(arrays_of(loaded.mesh), loaded.warnings);
}

py::tuple subdivide_arrays(const Rows<double>& positions, const Rows<std::int64_t>& triangles, unsigned count,
                           const std::string& scheme) {
  if (scheme != "midpoint" && scheme != "loop")
    throw Error(ErrorKind::input, "scheme", "\"" + scheme + "\" is no choice", "write one of midpoint, loop");
  const Subdivision as = scheme == "loop" ? Subdivision::loop : Subdivision::midpoint;
  return arrays_of(subdivide(mesh_of(positions, triangles), count, as));
}

// What a scene says, if it is right.
py::dict read_scene(const std::string& text, const std::string& file, const std::vector<std::string>& overrides) {
  const SceneDescription scene = parse_scene(text, file, overrides);
  py::list bodies;
  for (const BodyDescription& body : scene.bodies) bodies.append(body.name);
  py::dict told;
  told["title"] = scene.title;
  told["duration"] = scene.simulation.duration;
  told["frame_rate"] = scene.output.frame_rate;
  told["bodies"] = bodies;
  return told;
}

}  // namespace
}  // namespace pliant::python

PYBIND11_MODULE(_core, module) {
  using namespace pliant;
  using namespace pliant::python;
  py::register_exception_translator(raise_error);
  module.attr("version") = version();
  module.attr("commit") = commit();
  module.def("info", [] { return info(find_gpus()).text(); });
  module.def("info_of_integrators", [] { return info_of_integrators().text(); });
  module.def(
      "read_text", [](const std::string& path) { return read_text(path); }, py::arg("path"));
  module.def("read_scene", read_scene, py::arg("text"), py::arg("file"), py::arg("overrides"));
  module.def("load_mesh", load, py::arg("description"), py::arg("folder"));
  module.def(
      "check_mesh", [](const Rows<double>& positions, const Rows<std::int64_t>& triangles) { mesh_of(positions, triangles); },
      py::arg("positions"), py::arg("triangles"));
  module.def("subdivide", subdivide_arrays, py::arg("positions"), py::arg("triangles"), py::arg("count"), py::arg("scheme"));
  module.def(
      "report_mesh",
      [](const Rows<double>& positions, const Rows<std::int64_t>& triangles) {
        return to_json(report_mesh(mesh_of(positions, triangles)));
      },
      py::arg("positions"), py::arg("triangles"));
  module.def(
      "write_mesh",
      [](const std::string& path, const Rows<double>& positions, const Rows<std::int64_t>& triangles) {
        write_mesh(path, mesh_of(positions, triangles));
      },
      py::arg("path"), py::arg("positions"), py::arg("triangles"));
  define_simulation(module);
}
