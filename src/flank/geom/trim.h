/// The trimmed region of a face in its parameter plane.
#pragma once

#include <array>
#include <vector>

#include "flank/face.h"

namespace flank::internal {

/// [u0, u1] x [v0, v1] in the parameters of a surface, which have no unit.
struct ParameterRectangle {
  double u0 = 0.0, u1 = 1.0, v0 = 0.0, v1 = 1.0;
};

/// Answers whether a point of the parameter plane lies inside the loops (even-odd rule). The loops are replaced by
/// polylines that deviate from them by at most kTrimDeviation of the rectangle; ends of edges that do not meet are
/// joined by straight lines.
class TrimRegion {
 public:
  /// Of a rectangle: all of it inside or outside the region, or cut by a loop.
  enum class Side { kInside, kOutside, kCut };

  TrimRegion() = default;
  /// `rectangle` is the domain of the surface: what sticks out of it is clipped.
  TrimRegion(const std::vector<TrimLoop>& loops, const ParameterRectangle& rectangle);

  /// True where the loops bound the whole rectangle (or there are none): nothing is trimmed.
  [[nodiscard]] bool whole() const { return whole_; }
  /// The smallest rectangle that holds the region.
  [[nodiscard]] const ParameterRectangle& box() const { return box_; }

  /// Even-odd rule along the line v = constant; a point on a loop may fall on either side.
  [[nodiscard]] bool inside(double u, double v) const;
  /// Whether the given rectangle is all inside, all outside, or touched by a loop.
  [[nodiscard]] Side classify(const ParameterRectangle& r) const;

 private:
  /// A chord of a loop.
  struct Segment {
    double u0, v0, u1, v1;
  };
  /// Adds the polyline of an edge.
  void append(const BSplineCurve2& edge, std::vector<Vec2>& polyline) const;
  /// Sets whole_: every loop follows the border of the rectangle, and they enclose all of it.
  void find_whole(const std::vector<std::vector<Vec2>>& polylines);
  /// Sorts the segments into rows, so that inside() looks at few of them.
  void fill_rows();
  /// The row that holds v, clamped to the first and the last.
  [[nodiscard]] int row(double v) const;

  ParameterRectangle rectangle_, box_;
  bool whole_ = true;
  std::vector<Segment> segments_;
  std::vector<int> row_start_, row_items_;  ///< segments that overlap each of the horizontal rows that box_ is cut into
  /// Rows per unit of v.
  double rows_per_unit_ = 0.0;
};

/// A straight edge of a loop, over [0, 1].
[[nodiscard]] BSplineCurve2 straight_edge(const Vec2& from, const Vec2& to);

/// As a share of the rectangle, per direction.
inline constexpr double kTrimDeviation = 1e-7;

/// The border of a rectangle as a loop, u0 -> u1 along v0 first.
[[nodiscard]] TrimLoop rectangle_loop(const ParameterRectangle& r);

}  // namespace flank::internal
