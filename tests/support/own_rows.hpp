// A force and a response of the tests' own: a file and a row each.
#pragma once

namespace pliant {

inline constexpr double chain_stiffness = 5;  // [N/m]

/// Adds the force "chain", which acts on a body named "chained", and the response "halt". Later calls add nothing.
void add_own_rows();

}  // namespace pliant
