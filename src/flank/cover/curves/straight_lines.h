/// From integral curves to lines (paper B, sections 4.2 and 4.3): a least-squares line through each curve, measured,
/// with its best tangential velocity.
#pragma once

#include <optional>
#include <vector>

#include "flank/cover/curves/integral_curves.h"
#include "flank/obstacle/pose_guard.h"
#include "flank/seed/movability.h"
#include "flank/strip/line_fit.h"

namespace flank::internal {

/// The axis nearest to a curve in the sense of least squares over its points, each at its own s: with the means taken
/// off, u is along the sum of s c(s). The curve has two points or more.
[[nodiscard]] Pose line_through(const IntegralCurve& curve);

struct StraightLineOptions {
  /// Share of the axis in [0, 1] that the curve must run along. Half: from less the rest would be extrapolated by more
  /// than what is known. Raise it for fewer and surer lines.
  double least_span = 0.5;
  /// Share of the samples of the axis in [0, 1] whose footpoints must lie on the target. Lower it for narrow targets.
  double least_inside = 0.5;
  /// mm, > 0: largest |e_j| of the line (line_fit.h), and largest depth in the trimmed target. A few tolerances, as
  /// SMOOTH follows; 0, the default, accepts next to nothing: it must be set.
  double most_error_mm = 0.0;
  bool refine = false;  ///< REFINE each line (not in paper B): better lines, about a third more time
};

/// A line of a curve, measured along the whole axis: also where the curve does not run.
struct StraightLine {
  Pose pose;
  double error_mm = 0.0;    ///< largest |d(l(s_j)) - r(s_j)| over the samples inside the target
  double movability = 0.0;  ///< Movability::value: 0 on an exact envelope; no unit
  AxisVelocity velocity;    ///< the best tangential one (movability.h), in either sense
};

/// The line of a curve, or nothing if it is rejected. Lines that another face forbids slide along themselves until
/// they are clear, and are measured there. `fitter` is scratch.
[[nodiscard]] std::optional<StraightLine> straight_line(const IntegralCurve& curve, LineFitter& fitter,
                                                        const PoseGuard& guard, const StraightLineOptions& options);

}  // namespace flank::internal
