// The larger of two numbers, for largest errors that no NaN may slip through.
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>

namespace pliant {

/// Returns infinity if one of them is NaN.
template <std::floating_point T>
[[nodiscard]] T larger(T a, T b) {
  return std::isnan(a) || std::isnan(b) ? std::numeric_limits<T>::infinity() : std::max(a, b);
}

}  // namespace pliant
