/// Which small moves of an axis within its plane are still possible: a convex region of two numbers.
#pragma once

#include <array>
#include <cstddef>

#include "flank/vec.h"

namespace flank::internal {

/// Moves (rise, slope): the axis point at sigma from the point of contact rises by rise + slope * sigma, mm. A convex
/// polygon, cut by one pair of limits after another. Empty: none of the moves is possible.
class PosePlane {
 public:
  PosePlane() = default;
  /// All moves with |rise| <= most_rise and |slope| <= most_slope.
  PosePlane(double most_rise, double most_slope);

  /// Keeps the moves with low <= rise + slope * sigma <= high.
  void cut(double sigma, double low, double high);

  [[nodiscard]] bool empty() const { return count_ == 0; }
  /// Keeps what both have.
  void cut(const PosePlane& other);
  /// Largest |rise + slope * sigma|, mm; 0 if empty.
  [[nodiscard]] double most_rise(double sigma) const;
  /// Largest |slope|; 0 if empty.
  [[nodiscard]] double most_slope() const;
  /// Mean of the corners. Not if empty.
  [[nodiscard]] Vec2 middle() const;

 private:
  /// Keeps the moves with along.dot(move) <= limit. A polygon with more corners than there is room for is not cut: it then
  /// holds too many moves, never too few.
  void cut_above(const Vec2& along, double limit);

  static constexpr std::size_t kMostCorners = 64;
  std::array<Vec2, kMostCorners> corners_;  ///< counter-clockwise
  std::size_t count_ = 0;
};

}  // namespace flank::internal
