/// The trimmed region of a face in its parameter plane.
#pragma once

#include <array>
#include <vector>

#include "flank/face.h"

namespace flank::internal {

struct ParameterRectangle {
  double u0 = 0.0, u1 = 1.0, v0 = 0.0, v1 = 1.0;
};

/// Answers whether a point of the parameter plane lies inside the loops (even-odd rule). The loops are replaced by
/// polylines that deviate from them by at most kTrimDeviation of the rectangle; ends of edges that do not meet are
/// joined by straight lines.
class TrimRegion {
 public:
  enum class Side { kInside, kOutside, kCut };

  TrimRegion() = default;
  /// `rectangle` is the domain of the surface: what sticks out of it is clipped.
  TrimRegion(const std::vector<TrimLoop>& loops, const ParameterRectangle& rectangle);

  /// True where the loops bound the whole rectangle (or there are none): nothing is trimmed.
  [[nodiscard]] bool whole() const { return whole_; }
  /// The smallest rectangle that holds the region.
  [[nodiscard]] const ParameterRectangle& box() const { return box_; }

  [[nodiscard]] bool inside(double u, double v) const;
  /// Whether the given rectangle is all inside, all outside, or touched by a loop.
  [[nodiscard]] Side classify(const ParameterRectangle& r) const;

 private:
  struct Segment {
    double u0, v0, u1, v1;
  };
  void append(const BSplineCurve2& edge, std::vector<Vec2>& polyline) const;
  void find_whole(const std::vector<std::vector<Vec2>>& polylines);
  void fill_rows();
  [[nodiscard]] int row(double v) const;

  ParameterRectangle rectangle_, box_;
  bool whole_ = true;
  std::vector<Segment> segments_;
  std::vector<int> row_start_, row_items_;  ///< segments that overlap each of the horizontal rows that box_ is cut into
  double rows_per_unit_ = 0.0;
};

/// As a share of the rectangle, per direction.
inline constexpr double kTrimDeviation = 1e-7;

/// The border of a rectangle as a loop, u0 -> u1 along v0 first.
[[nodiscard]] TrimLoop rectangle_loop(const ParameterRectangle& r);

}  // namespace flank::internal
