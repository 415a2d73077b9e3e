/// A control point of a surface that went astray: damage that a file does not contradict anywhere else.
#pragma once

#include <optional>
#include <vector>

#include "flank/bspline_surface.h"

namespace flank::internal {

struct StrayPole {
  int u = 0, v = 0;  ///< its place in the net
  double off = 0.0;  ///< of a point: mm from where its neighbours lead one to expect it; of a weight: by which factor
};

/// The one control point that lies far from the line of its neighbours in both directions: by more than a hundredth of the size of the net,
/// and by more than five times as much as any other. A crease is a line of such points, and no stray. None of rational nets, whose
/// control points are no outline of the surface, and of nets of fewer than four rows or columns, which have too few others.
[[nodiscard]] std::optional<StrayPole> stray_pole(const BSplineSurface& surface);

/// The one weight of a rational net that is far from those of its neighbours in both directions: by a quarter or more, and by more than
/// five times as much (as logarithms) as any other. Weights of circles differ along a row, and those of all rows alike. Weights > 0.
[[nodiscard]] std::optional<StrayPole> stray_weight(const BSplineSurface& surface);

/// By which factor the one weight of a rational curve that stands alone is off those beside it; 0: there is none. An arc is led by a
/// single weight as well: four times is what an arc of 151 degrees has, and arcs are cut before that.
[[nodiscard]] double stray_curve_weight(const std::vector<double>& weights);

}  // namespace flank::internal
