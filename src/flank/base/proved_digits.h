/// Figures of proofs for people: rounded the way that keeps them true.
#pragma once

#include <cmath>

namespace flank::internal {

/// The nearest figure of so many significant digits that is no larger, for "at least"; x > 0. What is within 1e-9 of a unit of the last digit
/// counts as that.
[[nodiscard]] inline double digits_below(double x, int digits) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - digits + 1);
  return unit * std::floor(x / unit + 1e-9);
}

/// That is no smaller, for "of all from"; x > 0.
[[nodiscard]] inline double digits_above(double x, int digits) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - digits + 1);
  return unit * std::ceil(x / unit - 1e-9);
}

}  // namespace flank::internal
