/// The smallest radius of a free tool where a job gives none.
#pragma once

namespace flank::internal {

/// Of a target's diagonal.
inline constexpr double kSmallestRadiusShare = 0.01;

}  // namespace flank::internal
