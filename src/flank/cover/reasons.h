/// Why a tool does not cover what was asked: the sentence for the user, with its figures.
#pragma once

#include <string>

#include "flank/cover/strip_cover.h"
#include "flank/surface/target.h"
#include "flank/tool/radial_function.h"

namespace flank {

/// Largest concave curvature of the target (1/mm, 0 where none is concave) and where.
struct ConcavePlace {
  double curvature = 0.0;
  Vec3 point = Vec3::Zero();
};
[[nodiscard]] ConcavePlace most_concave(const Target& target, const CoverSamples& samples);

/// One sentence. The tool's radius against the most concave place where that forbids it; else the largest uncovered
/// patch.
[[nodiscard]] std::string reason_of(const Target& target, const RadialFunction& radial, const CoverSamples& samples,
                                    const std::vector<CoverStrip>& strips, double tolerance_mm);

}  // namespace flank
