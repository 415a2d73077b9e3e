/// How well two motions over the facing sides of a cavity go together.
#pragma once

#include <span>

#include "flank/ruled_motion.h"

namespace flank::internal {

/// How far the ends of the axes of two motions that face each other lie apart along the way while the middles are across
/// from each other, as a share of the axis length: mean over the way. A cycle must make up for it in every half.
[[nodiscard]] double stagger(const RuledMotion& left, const RuledMotion& right);

/// Mean over the pairs (2 k, 2 k + 1); an even number of motions.
[[nodiscard]] double mean_stagger(std::span<const RuledMotion> motions);

/// How far the axis leans along its way, in both directions: |u . way|, mean over the way and the motions.
[[nodiscard]] double mean_lean(std::span<const RuledMotion> motions);

}  // namespace flank::internal
