/// Where the trims of a face run in its parameter plane, to tell which rectangles lie inside, outside, or on them.
#pragma once

#include <vector>

#include "flank/face.h"
#include "flank/verify/proof/patch_bounds.h"

namespace flank::internal::verify {

enum class Side { kInside, kOutside, kAcross };

/// The loops of a face, each curve cut into chords that are surely within a known distance of it. Immutable.
class Border {
 public:
  /// `tolerance` (per coordinate, parameters): how near the chords keep to the curves.
  Border(const std::vector<BSplineCurve2>& curves, const Vec2& tolerance);

  /// Never wrong about kInside and kOutside; kAcross may be said of a rectangle that only comes near.
  [[nodiscard]] Side side(const Rectangle& where) const;
  /// Even-odd; within the tolerance of the curves it may say either.
  [[nodiscard]] bool inside(const Vec2& point) const;
  /// Around all chords.
  [[nodiscard]] const Rectangle& box() const { return box_; }

 private:
  struct Chord {
    Vec2 a, b;
  };
  void add(const BSplineCurve2& curve, double low, double high, int depth);
  [[nodiscard]] int row(double v) const;
  [[nodiscard]] bool meets(const Chord& chord, const Rectangle& where) const;

  Vec2 tolerance_;
  Rectangle box_{Vec2::Constant(1e300), Vec2::Constant(-1e300)};
  std::vector<Chord> chords_;
  std::vector<std::vector<int>> rows_;  ///< chords that come into a row of v
};

/// Distinct knots of a curve's domain, ascending.
[[nodiscard]] std::vector<double> distinct_knots(const std::vector<double>& knots, double first, double last);

/// The curves of a face's loops, and chords where they do not meet.
[[nodiscard]] std::vector<BSplineCurve2> border_curves(const Face& face);

/// Inner knots across which a surface has a kink or worse, ascending.
[[nodiscard]] std::vector<double> kinks(const std::vector<double>& knots, int degree, double first, double last);

}  // namespace flank::internal::verify
