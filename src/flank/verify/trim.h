/// Which points of the parameter plane lie inside a face's trims: even-odd along lines of constant v.
#pragma once

#include <vector>

#include "flank/face.h"

namespace flank::internal::verify {

/// The loops as polylines; immutable. A face without loops has everything inside. Loops may be oriented in any way, and
/// holes are loops like others: even-odd needs neither. All of it in the surface's parameters, which have no unit.
class Trim {
 public:
  /// Chords stay within `tolerance_u`, `tolerance_v` of the trimming curves (parameter units).
  Trim(const std::vector<TrimLoop>& loops, double tolerance_u, double tolerance_v);

  /// Where the line v = constant crosses the loops, ascending in u: inside between the 1st and 2nd, 3rd and 4th, ...
  [[nodiscard]] std::vector<double> crossings(double v) const;
  [[nodiscard]] bool everything() const { return everything_; }  ///< there are no loops
  /// Even-odd test of u against the crossings of its line.
  [[nodiscard]] bool inside(const std::vector<double>& crossings, double u) const;
  /// Smallest rectangle around the loops; meaningless without any.
  [[nodiscard]] Vec2 low() const { return low_; }
  [[nodiscard]] Vec2 high() const { return high_; }

 private:
  /// A side of a polyline; its ends in parameters.
  struct Chord {
    Vec2 a, b;
  };
  void add(const BSplineCurve2& edge, double tolerance_u, double tolerance_v);
  /// Joins edges whose ends do not meet.
  void close(const Vec2& from, const Vec2& to) { chords_.push_back({from, to}); }

  bool everything_ = true;
  /// Of all chords; low > high while there are none.
  Vec2 low_ = Vec2::Constant(1e300), high_ = Vec2::Constant(-1e300);
  std::vector<Chord> chords_;
};

}  // namespace flank::internal::verify
