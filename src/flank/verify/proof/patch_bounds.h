/// How far a B-spline surface or a trimming curve can lie from its own middle: by the control points of the piece, which
/// hold it, and nothing is sampled.
#pragma once

#include <vector>

#include "flank/bspline_curve.h"
#include "flank/bspline_surface.h"
#include "flank/vec.h"

namespace flank::internal::verify {

/// Parameters of a surface: [low.x, high.x] x [low.y, high.y].
struct Rectangle {
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
  [[nodiscard]] Vec2 middle() const { return 0.5 * (low + high); }
};

/// What a surface does over a rectangle. Derivatives are by the place in the rectangle, from 0 to 1 in both directions,
/// so all of them are lengths, mm: upper bounds of their norms. Not proved where a weight is not positive: infinite.
struct PatchBounds {
  Vec3 middle = Vec3::Zero();  ///< S at the middle of the rectangle
  double reach = 0.0;          ///< no point of the patch is farther from `middle`
  double du = 0.0, dv = 0.0, duu = 0.0, duv = 0.0, dvv = 0.0;
  /// How far the middle can lie from a tangent plane of the patch.
  [[nodiscard]] double bend() const { return 0.125 * (duu + 2.0 * duv + dvv); }
};

/// Whether the rectangle lies in one knot span of both directions.
[[nodiscard]] bool one_piece(const BSplineSurface& surface, const Rectangle& where);
/// Bounds over a rectangle inside one knot span.
[[nodiscard]] PatchBounds patch_bounds(const BSplineSurface& surface, const Rectangle& where);
/// Adds the control points over a rectangle inside one knot span, whose convex hull holds the patch; false, and none, where a
/// weight is not positive.
[[nodiscard]] bool add_control_points(const BSplineSurface& surface, const Rectangle& where, std::vector<Vec3>& points);
/// A ball around any rectangle, by the control points that act there: centre and radius only.
[[nodiscard]] PatchBounds loose_bounds(const BSplineSurface& surface, const Rectangle& where);

/// What a curve in the parameter plane does over [low, high] inside one knot span: the rectangle that holds it, and upper bounds
/// of its derivatives by the place in the interval, from 0 to 1, for each coordinate.
struct CurveBounds {
  Rectangle box;
  Vec2 d1 = Vec2::Zero(), d2 = Vec2::Zero();
};
[[nodiscard]] CurveBounds curve_bounds(const BSplineCurve2& curve, double low, double high);

}  // namespace flank::internal::verify
