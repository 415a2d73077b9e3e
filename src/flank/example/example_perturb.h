/// Starts of fits beside the exact motion.
#pragma once

#include "flank/base/random.h"
#include "flank/ruled_motion.h"

namespace flank::internal {

/// The same motion off by a smooth rigid perturbation of low frequency (a slowly varying shift and turn about
/// mid-axis): its largest displacement over both ends of the axis is `relative` times `diagonal_mm`, to about 1
/// percent. For starts of fits.
[[nodiscard]] RuledMotion perturb(const RuledMotion& motion, double relative, double diagonal_mm, Random& random);

}  // namespace flank::internal
