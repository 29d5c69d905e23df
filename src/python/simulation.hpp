// Simulations as Python objects.
#pragma once
#include <pybind11/pybind11.h>

namespace pliant::python {

/// Adds the class Simulation to a module.
void define_simulation(pybind11::module_& module);

}  // namespace pliant::python
