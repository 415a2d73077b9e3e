/// A proof that a moving flank enters no face of the part deeper than is allowed.
#pragma once

#include <array>

#include "flank/geom/triangle_bvh.h"
#include "flank/radial_function.h"
#include "flank/vec.h"

namespace flank::internal {

/// The flank cuts a face by the most that r(s) is above the distance from the axis' point p(s, t) to the face, over all s and t.
/// On a cell of s and t the squared distance to any set, less |p|^2, is a least of linear functions, and so concave: it is at least the
/// mean of its four corners, less the mean of the squares of how far p is from them, a quarter of the sum of the squared sides at most.
/// Cells are halved until that decides. Sheets count from both sides. Immutable.
class MotionGuard {
 public:
  /// `triangles`: of all faces that must not be cut, nowhere more than `off_mm` beside them. `most_mm`: that a face may be cut.
  /// Neither is copied.
  MotionGuard(const TriangleBvh& triangles, double off_mm, const RadialFunction& radial, double most_mm);

  /// Of the motion from one pose to the next: tip and unnormalised axis run straight.
  [[nodiscard]] bool is_free(const Pose& from, const Pose& to) const;
  /// How deep the flank enters at one pose, mm, at samples of its axis; < 0: it keeps off by so much. And the unit vector from there to the axis.
  struct Depth {
    double mm = -1e300;
    Vec3 away = Vec3::UnitZ();
  };
  [[nodiscard]] Depth depth(const Pose& pose) const;

 private:
  struct Motion;
  struct Cell;
  [[nodiscard]] double corner(const Motion& motion, double s, double t) const;
  [[nodiscard]] bool is_free(const Motion& motion, const Cell& cell) const;
  [[nodiscard]] bool decides(const Motion& motion, const Cell& cell) const;

  const TriangleBvh& triangles_;
  const RadialFunction& radial_;
  double off_mm_, most_mm_;
};

}  // namespace flank::internal
