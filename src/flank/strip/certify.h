/// CERTIFY, as far as the planner can: the judge has the last word.
#pragma once

#include "flank/obstacle/line_guard.h"
#include "flank/strip/strip_measure.h"

namespace flank::internal {

/// No overcut beyond kCertifiedShare of the tolerance, and clear of the guard's obstacles from end to end.
[[nodiscard]] bool is_certified(const LineGuard& guard, const CoverStrip& strip, double tolerance_mm);

/// A strip that cuts too deep here and there, lifted there by as much, with ramps that its rails can follow; where it
/// enters another face it slides along its axis in the same way. What it leaves instead is within the tolerance where the
/// excess was small.
[[nodiscard]] CoverStrip lifted(const CoverSamples& samples, const LineGuard& guard, CoverStrip strip,
                                const RadialFunction& radial, LineFitter& fitter);

/// A strip that fails is cut short: the longest stretch of it that does not remains. No cells where that is less than a
/// tenth.
[[nodiscard]] CoverStrip cut_to_certified(const CoverSamples& samples, const LineGuard& guard, CoverStrip strip,
                                          const RadialFunction& radial, LineFitter& fitter);

/// Past the last points of the target that hold them, rails may run off within one of the certificate's steps. Where a
/// look in a thousand steps finds that, or another face, the strip is lifted, and what does not help is cut off. No cells where a tenth of it is not left.
[[nodiscard]] CoverStrip cut_finely(const CoverSamples& samples, const LineGuard& guard, CoverStrip strip,
                                    const RadialFunction& radial, LineFitter& fitter);

}  // namespace flank::internal
