// How little a body moves that may fall asleep.
#pragma once
#include "model/model.hpp"

namespace pliant {

/// Returns how fast a body may be that may sleep [m/s], but for its trembling. `gravity` is the size of the acceleration [m/s^2].
[[nodiscard]] double sleep_speed(const Model& model, double gravity);
/// Returns how far a body that may sleep may be from where its slow time began [m].
[[nodiscard]] double sleep_way(const Model& model, double gravity);

}  // namespace pliant
