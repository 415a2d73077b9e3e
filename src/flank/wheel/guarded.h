/// Paths held against the whole part: what would cut a face is lifted off, or left out.
#pragma once

#include "flank/path.h"
#include "flank/wheel/wheel_work.h"

namespace flank::internal {

/// Poses that enter a face by more than most of the tolerance are moved out of it, and their neighbours with them, less and less.
[[nodiscard]] Path lifted(WheelWork& work, const Path& path);

/// The stretches of the strips in which the flank is proved to enter no face of the part by more than the tolerance, their own faces
/// among them (MotionGuard), and a shank above it nothing of the whole wheel.
[[nodiscard]] Path guarded(WheelWork& work, const Path& path);
/// How sharply what is left may turn: as the judge of a finished face allows, or as it likes.
enum class Turns { kHeld, kAny };
/// The same with another tool, and another depth; < 0: it keeps off so far.
[[nodiscard]] Path guarded(WheelWork& work, const Path& path, const Tool& tool, double most_mm, Turns turns);

}  // namespace flank::internal
