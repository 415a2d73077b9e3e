/// Why a tool does not cover the whole target: the sentence for the user, with its figures.
#pragma once

#include <string>

#include "flank/radial_function.h"
#include "flank/strip/strip_measure.h"
#include "flank/target.h"

namespace flank::internal {

/// The most concave place of a target.
struct ConcavePlace {
  /// Larger principal curvature, 1/mm; a sphere of radius above 1/curvature does not fit there
  double curvature = 0.0;
  Vec3 point = Vec3::Zero();  ///< of the target; meaningless if the curvature is 0
};
/// The largest concave curvature over the cells that no strip covers; 0 if none of them is concave. Strips must have
/// been measured with `samples`.
[[nodiscard]] ConcavePlace most_concave(const Target& target, const CoverSamples& samples,
                                        const std::vector<CoverStrip>& strips);

/// One sentence without a full stop, in mm. In this order: the tool's smallest radius is too large for the most concave
/// place that is not covered; there is no strip, so no line of the tool suits the target; the largest patch that is not
/// covered, with its area and its middle. Empty if all is covered. Strips must have been measured with `samples`.
[[nodiscard]] std::string reason_of(const Target& target, const RadialFunction& radial, const CoverSamples& samples,
                                    const std::vector<CoverStrip>& strips, double tolerance_mm);

}  // namespace flank::internal
