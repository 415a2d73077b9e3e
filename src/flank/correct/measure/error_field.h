/// The error of a machine as smooth fields over a face, one for each pass of the plan.
#pragma once

#include <cstddef>
#include <vector>

#include "flank/bspline_surface.h"

namespace flank::internal {

/// Middle of the absolute values, as a standard deviation.
[[nodiscard]] double typical(std::vector<double> values);

/// A measured point on the face.
struct MeasuredPoint {
  int index = 0;            ///< of the point in the file
  Vec3 point;               ///< where it is taken to be
  double u = 0.0, v = 0.0;  ///< of its nearest point, from 0 to 1 over the face's domain
  double error_mm = 0.0;    ///< along the normal, beyond what the plan leaves; positive: material is left
  /// By how much each pass of the plan leaves more there than the one that leaves the least; none: there is one pass.
  std::vector<double> higher_mm = {};
};

/// Where passes overlap, the cut is that of the one which leaves the least, with its error. So the error has steps and kinks there, but
/// that of each pass is smooth.
struct ErrorField {
  std::vector<BSplineSurface> passes;  ///< of each pass as x over [0, 1]^2, mm
  double noise_mm = 0.0;               ///< of the points, standard deviation, estimated

  [[nodiscard]] double of_pass(std::size_t pass, double u, double v) const;
  /// The pass that leaves the least there, with its error. `higher_mm`: see MeasuredPoint.
  [[nodiscard]] std::size_t lowest(double u, double v, const std::vector<double>& higher_mm) const;
  /// The error of what all passes leave together.
  [[nodiscard]] double at(double u, double v, const std::vector<double>& higher_mm) const;
};

struct SmoothedError {
  ErrorField field;
  std::vector<MeasuredPoint> points;  ///< those that count
  std::vector<int> outliers;          ///< indices of those that do not, ascending
};

/// Fields whose size generalised cross-validation chooses, without points that are far off them. A point belongs to the pass that leaves
/// the least there; this is asked again with each new field. Where a pass has too few points for a field, all passes have the same.
[[nodiscard]] SmoothedError smoothed_error(const std::vector<MeasuredPoint>& points);

}  // namespace flank::internal
