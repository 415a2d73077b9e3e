/// A shank that comes too near is lifted: the free tool's flank is lengthened above the face.
#pragma once

#include <functional>

#include "flank/fit.h"
#include "flank/fit/stages.h"
#include "flank/radial_function.h"

namespace flank::internal {

/// The radial function on an axis longer by `more_mm` at the upper end, and by `at_tip_mm` at the tip: as it was, then on with its slope, which
/// fades to nothing. What was at s is at s + at_tip_mm then. Splines only.
[[nodiscard]] RadialFunction lengthened(const RadialFunction& radial, double more_mm, double at_tip_mm = 0.0);

/// Lengthens tool and motions by 1, 2, 4, 8 times `step_mm`, until the tool is legitimate and `clear` says of the result
/// that shank and holder keep their clearances; returns the millimetres that were added. 0 where it is clear as it is,
/// and where nothing helps: then the result is as it was.
[[nodiscard]] double lengthen_until_clear(FlankFitResult& fit, double step_mm,
                                          const std::function<bool(const FlankFitResult&)>& clear);

/// The draft with motions that go on at both ends as the polynomials that their rails are there, by `share` of their time: a border that an
/// end has touched, which leaves what a pose is and no envelope, is touched before that then. As many control points as before: what is a
/// little off is an envelope as well.
[[nodiscard]] FitDraft run_on(const FitDraft& draft, double share);

}  // namespace flank::internal
