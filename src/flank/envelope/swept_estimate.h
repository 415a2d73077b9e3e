/// A quick estimate of the swept distance f(x) = min over t, s of |x - R(s,t)| - r(s), for planners that rank many
/// motions. The judge has its own, exact one.
#pragma once

#include <vector>

#include "flank/motion/ruled_motion.h"
#include "flank/tool/radial_function.h"

namespace flank {

class SweptEstimate {
 public:
  /// `poses` axis positions a motion are tabulated.
  SweptEstimate(const std::vector<RuledMotion>& motions, const RadialFunction& radial, int poses);

  /// Estimate of f: least over the tabulated poses, improved by a parabola through its neighbours; the axis parameter
  /// of a contact by two fixed-point steps s = z + r' rho / sqrt(1 - r'^2). Error of third order in the spacing of the
  /// poses.
  [[nodiscard]] double distance(const Vec3& x) const;

 private:
  [[nodiscard]] double at_pose(const Pose& pose, const Vec3& x) const;

  std::vector<std::vector<Pose>> poses_;
  std::vector<double> radius_, lean_;  ///< r and r'/sqrt(1-r'^2) at equal steps of s
  double axis_length_;
  double per_length_;
};

}  // namespace flank
