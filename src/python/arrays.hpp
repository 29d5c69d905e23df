// Brings numpy's arrays to the library's types and back.
#pragma once
#include <pybind11/numpy.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "core/error.hpp"
#include "mesh/triangle_mesh.hpp"

namespace pliant::python {

namespace py = pybind11;

/// An array of rows of numbers that is contiguous, made from what Python gave.
template <class T>
using Rows = py::array_t<T, py::array::c_style | py::array::forcecast>;

/// Throws Error (input) unless an array has `columns` columns, and `rows` rows if that is not negative. `name` is the argument's.
inline void expect_shape(const py::array& array, py::ssize_t rows, py::ssize_t columns, const char* name) {
  if (array.ndim() == 2 && array.shape(1) == columns && (rows < 0 || array.shape(0) == rows)) return;
  std::string shape;
  for (py::ssize_t k = 0; k < array.ndim(); ++k) shape += (k > 0 ? ", " : "") + std::to_string(array.shape(k));
  throw Error(ErrorKind::input, name, "has the shape (" + shape + ")",
              "give it the shape (" + (rows < 0 ? "n" : std::to_string(rows)) + ", " + std::to_string(columns) + ")");
}

/// Returns vectors of a contiguous (n, 3) array.
inline std::span<const glm::dvec3> vectors_of(const Rows<double>& array) {
  static_assert(sizeof(glm::dvec3) == 3 * sizeof(double));
  return {reinterpret_cast<const glm::dvec3*>(array.data()), static_cast<std::size_t>(array.shape(0))};
}

inline std::span<glm::dvec3> vectors_in(py::array_t<double, py::array::c_style>& array) {
  return {reinterpret_cast<glm::dvec3*>(array.mutable_data()), static_cast<std::size_t>(array.shape(0))};
}

/// Returns a new (n, 3) array.
inline py::array_t<double> array_of(std::span<const glm::dvec3> vectors) {
  py::array_t<double> array({static_cast<py::ssize_t>(vectors.size()), py::ssize_t{3}});
  std::copy_n(reinterpret_cast<const double*>(vectors.data()), 3 * vectors.size(), array.mutable_data());
  return array;
}
inline py::array_t<double> array_of(const glm::dvec3& v) {
  py::array_t<double> array(3);
  std::copy_n(&v.x, 3, array.mutable_data());
  return array;
}

inline py::array_t<std::uint32_t> array_of(std::span<const std::array<std::uint32_t, 3>> triangles) {
  py::array_t<std::uint32_t> array({static_cast<py::ssize_t>(triangles.size()), py::ssize_t{3}});
  std::copy_n(reinterpret_cast<const std::uint32_t*>(triangles.data()), 3 * triangles.size(), array.mutable_data());
  return array;
}

/// Returns the mesh with these (n, 3) positions [mesh units] and (m, 3) vertex numbers. Throws Error (input).
TriangleMesh mesh_of(const Rows<double>& positions, const Rows<std::int64_t>& triangles);

}  // namespace pliant::python
