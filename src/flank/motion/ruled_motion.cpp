#include "flank/ruled_motion.h"

#include "flank/base/assert.h"
#include "flank/error.h"

namespace flank {

Pose RuledMotion::pose(double t) const { return {tip.value(t), direction.value(t).normalized()}; }

AxisJet RuledMotion::jet(double t) const {
  const CurveJet<3> a = tip.jet(t), w = direction.jet(t);
  AxisJet axis;
  axis.tip = a.p;
  axis.tip_d1 = a.d1;
  const double length = w.p.norm();
  axis.u = w.p / length;
  // u' is the part of w' across u: the rest only changes the length of w.
  axis.u_d1 = (w.d1 - w.d1.dot(axis.u) * axis.u) / length;
  return axis;
}

RuledMotion fit_motion(const std::vector<Pose>& poses, const std::vector<double>& t, double axis_length, int count) {
  FLANK_ASSERT(axis_length > 0.0);
  if (poses.size() != t.size()) throw InternalError("fit_motion needs one parameter for every pose");
  if (count < 4 || static_cast<int>(poses.size()) < count)
    throw InternalError("fit_motion needs at least 4 control points and at least as many poses, got " +
                        std::to_string(count) + " and " + std::to_string(poses.size()));
  Eigen::Matrix3Xd tips(3, poses.size()), directions(3, poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    tips.col(i) = poses[i].tip;
    directions.col(i) = poses[i].axis.normalized();
  }
  return {axis_length, fit_curve(tips, t, 3, count), fit_curve(directions, t, 3, count)};
}

}  // namespace flank
