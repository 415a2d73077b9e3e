/// What a state of the fit covers, by the planner's own estimate, and what it leaves at the axis.
#pragma once

#include <vector>

#include "flank/fit.h"

namespace flank::internal {

/// Which samples of an estimate are refined exactly: those with f < 0, the others being of third order in the spacing of the poses, which a tool
/// that is thin beside the way between two poses makes large; or all.
enum class Refined { kCuts, kAll };

/// The estimate for a set of motions over one target's samples, `poses` axis positions per motion tabulated. Samples
/// with area 0 count for overcut and undercut alone, those with the negative of theirs for the share of the whole, too.
[[nodiscard]] CoverageEstimate estimate_coverage(const std::vector<SurfaceSample>& samples,
                                                 const std::vector<RuledMotion>& motions, const RadialFunction& tool,
                                                 double tolerance_mm, int poses, Refined refined = Refined::kCuts);

/// Those of the samples that are cut deeper than this, mm, by the estimate's own figures.
[[nodiscard]] std::vector<Vec3> cut_deeper_than(double depth_mm, const std::vector<SurfaceSample>& samples,
                                                const std::vector<RuledMotion>& motions, const RadialFunction& tool,
                                                int poses);

/// Balls h apart leave up to h^2 / (8 r) of the flank between them: a close look sees most of that, about the deepest place
/// of each pose. For a rough one the depth of what is far inside is estimated.
enum class GougeLook { kRough, kQuick, kClose };

/// The deepest that flank and shank (that of the bounds, if it is in the way) enter an obstacle, mm, >= 0, at poses + 1 times per motion and at least 60 places
/// along the flank's axis; obstacles as in FitDraft (one per motion, null: none, or none at all).
[[nodiscard]] double flank_gouge(const std::vector<RuledMotion>& motions,
                                 const std::vector<const ObstacleField*>& obstacles, const RadialFunction& tool,
                                 const RadiusBounds& bounds, int poses, GougeLook look = GougeLook::kQuick);

/// Residuals on a grid of count_t x count_s (both >= 2) per motion with cold footpoints, so a footpoint that a pass
/// followed onto a wrong branch shows. Samples whose footpoint is on the border are left out of all but inside_share.
[[nodiscard]] ResidualSummary validate(const std::vector<FitTask>& tasks, const RadialFunction& tool, int count_t,
                                       int count_s);

}  // namespace flank::internal
