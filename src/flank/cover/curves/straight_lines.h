/// From integral curves to lines (paper B, sections 4.2 and 4.3): a least-squares line through each curve, measured, with
/// its best tangential velocity.
#pragma once

#include <optional>
#include <vector>

#include "flank/cover/curves/integral_curves.h"
#include "flank/obstacle/line_guard.h"
#include "flank/seed/movability.h"
#include "flank/strip/line_fit.h"

namespace flank::internal {

/// The axis nearest to a curve in the sense of least squares over its points, each at its own s: with the means taken off,
/// u is along the sum of s c(s). The curve has two points or more.
[[nodiscard]] Pose line_through(const IntegralCurve& curve);

struct StraightLineOptions {
  double least_span = 0.5;     ///< of the axis that the curve must run along
  double least_inside = 0.5;   ///< of the axis whose footpoints must lie on the target
  double most_error_mm = 0.0;  ///< of the line: |e_j| (line_fit.h), and its depth in the trimmed target
  bool refine = false;         ///< REFINE each line (not in paper B)
};

struct StraightLine {
  Pose pose;
  double error_mm = 0.0;  ///< largest |d(l(s_j)) - r(s_j)| over the samples inside the target
  double movability = 0.0;
  AxisVelocity velocity;  ///< the best tangential one (movability.h), in either sense
};

/// The line of a curve, or nothing where it is rejected. Lines that another face forbids slide along themselves until they
/// are clear, and are measured there. `fitter` is scratch.
[[nodiscard]] std::optional<StraightLine> straight_line(const IntegralCurve& curve, LineFitter& fitter,
                                                        const LineGuard& guard, const StraightLineOptions& options);

}  // namespace flank::internal
