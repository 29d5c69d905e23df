// Deforms bodies before they start, so that springs work from the first step on.
#pragma once
#include <functional>

#include "model/model.hpp"

namespace pliant {

/// Moves each vertex by what `by` returns for its index [m], in its body's frame.
void displace(State& state, const std::function<glm::dvec3(std::size_t vertex)>& by);

/// Scales each body about its centroid by 1 + `strain`. This is its breathing mode, which is linear at any strain.
void swell(const Model& model, State& state, double strain);

}  // namespace pliant
