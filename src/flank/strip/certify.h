/// CERTIFY, as far as the planner can: the judge has the last word.
///
/// A certificate is a set of samples, not a proof: depths at depth_poses(motion) poses and at the points of
/// CoverSamples, clearances at the same poses. Limits below the tolerance (base/tolerance_budget.h, the guard's floor)
/// leave room for what lies between the samples. All functions here are deterministic; `fitter` is scratch memory of the
/// calling thread, must belong to the same target and tool, and carries the tolerance (fitter.options().tolerance_mm).
#pragma once

#include <vector>

#include "flank/obstacle/pose_guard.h"
#include "flank/strip/kinks.h"
#include "flank/strip/strip_measure.h"

namespace flank::internal {

/// Whether the strip has cells, cuts the target no deeper than TargetDepthBudget::certified tolerances, and has no
/// pose that is deeper in an obstacle than the guard's floor. The depth is strip.overcut_mm, so the strip must be measured.
[[nodiscard]] bool is_certified(const PoseGuard& guard, const CoverStrip& strip, double tolerance_mm);

/// The strip lifted out of the target wherever it is too deep, by as much as it is too deep, and slid along its axis
/// wherever it enters another face, both with ramps that its rails can follow; measured again. Returned as it is if
/// nothing is too deep. At most four rounds, so the result may still fail its certificate: check with is_certified.
/// Material that the lift leaves is within the tolerance as long as the excess was small.
[[nodiscard]] CoverStrip lifted(const CoverSamples& samples, const PoseGuard& guard, CoverStrip strip,
                                const RadialFunction& radial, LineFitter& fitter);

/// The strip cut to its longest stretch that passes the certificate; as it is if all of it does. Always certified, or
/// without cells: then less than a tenth of the strip passed, or three cuts were not enough.
[[nodiscard]] CoverStrip cut_to_certified(const CoverSamples& samples, const PoseGuard& guard, CoverStrip strip,
                                          const RadialFunction& radial, LineFitter& fitter);

/// The strip without its kinks: its stretches between them, each certified; as it is if it has none. Empty if nothing of it
/// is certified.
[[nodiscard]] std::vector<CoverStrip> cut_at_kinks(const CoverSamples& samples, const PoseGuard& guard,
                                                   CoverStrip strip, const RadialFunction& radial, LineFitter& fitter,
                                                   const TurnLimit& limit);

/// The last look. Beyond the last points of the target nothing holds the rails between two steps of the certificate, so
/// each strip is checked again at a thousand steps. What is too deep, or in another face, is lifted, and cut off if
/// that does not help. Returns a strip without cells if less than a tenth of it is left. A thousand poses cost several
/// certificates: for the strips that are kept, once.
[[nodiscard]] CoverStrip cut_finely(const CoverSamples& samples, const PoseGuard& guard, CoverStrip strip,
                                    const RadialFunction& radial, LineFitter& fitter);

}  // namespace flank::internal
