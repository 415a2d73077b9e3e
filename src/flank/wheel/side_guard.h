/// Paths of the sides held against everything else.
#pragma once

#include "flank/path.h"
#include "flank/wheel/wheel_work.h"

namespace flank::internal {

/// The stretches of the strips in which the flank enters no face but their own by more than most of the tolerance. The part must hold the
/// strips' faces.
[[nodiscard]] Path kept_free(WheelWork& work, const Path& path);

}  // namespace flank::internal
