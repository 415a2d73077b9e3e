/// Paths held against the whole part: what would cut a face is lifted off, or left out.
#pragma once

#include "flank/path.h"
#include "flank/wheel/point/motion_guard.h"
#include "flank/wheel/wheel_work.h"

namespace flank::internal {

/// Motions of a tool that goes nowhere but near some strips: whether its flank is proved to enter no face of the part by more than is allowed
/// (MotionGuard), and a shank above it nothing of the whole wheel.
class PathGuard {
 public:
  /// `most_mm` < 0: it keeps off so far. The work keeps the triangles until another guard asks for those of other faces.
  PathGuard(WheelWork& work, const Path& around, const Tool& tool, double most_mm);
  PathGuard(const PathGuard&) = delete;
  PathGuard& operator=(const PathGuard&) = delete;
  [[nodiscard]] bool is_free(const Pose& from, const Pose& to) const;

 private:
  MotionGuard flank_;
  RadialFunction rod_;
  double rod_from_mm_;
  MotionGuard shank_;
};

/// Poses that enter a face by more than most of the tolerance are moved out of it, and their neighbours with them, less and less.
[[nodiscard]] Path lifted(WheelWork& work, const Path& path);

/// The stretches of the strips in which a PathGuard proves all motions, by a little less than the tolerance.
[[nodiscard]] Path guarded(WheelWork& work, const Path& path);
/// How sharply what is left may turn: as the judge of a finished face allows, or as it likes.
enum class Turns { kHeld, kAny };
/// The same with another tool, and another depth; < 0: it keeps off so far.
[[nodiscard]] Path guarded(WheelWork& work, const Path& path, const Tool& tool, double most_mm, Turns turns);

}  // namespace flank::internal
