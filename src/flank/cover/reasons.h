/// Why a tool does not cover what was asked: the sentence for the user, with its figures.
#pragma once

#include <string>

#include "flank/radial_function.h"
#include "flank/strip/strip_measure.h"
#include "flank/target.h"

namespace flank::internal {

/// Largest concave curvature (1/mm, 0 where none is concave) over those cells that no strip covers, and where.
struct ConcavePlace {
  double curvature = 0.0;
  Vec3 point = Vec3::Zero();
};
[[nodiscard]] ConcavePlace most_concave(const Target& target, const CoverSamples& samples,
                                        const std::vector<CoverStrip>& strips);

/// One sentence. The tool's radius against the most concave place that is not covered, where that forbids it; else the
/// largest uncovered patch; empty where all is covered.
[[nodiscard]] std::string reason_of(const Target& target, const RadialFunction& radial, const CoverSamples& samples,
                                    const std::vector<CoverStrip>& strips, double tolerance_mm);

}  // namespace flank::internal
