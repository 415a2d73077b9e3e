#include "flank/fit/model/axis_grid.h"

#include <algorithm>

#include "flank/base/assert.h"

namespace flank::internal {

AxisGrid::AxisGrid(const RuledMotion& motion, int samples_t, int samples_s) : axis_length_(motion.axis_length) {
  FLANK_ASSERT(samples_t >= 2 && samples_s >= 2);
  for (int i = 0; i < samples_t; ++i) {
    Time time{};
    time.t = static_cast<double>(i) / (samples_t - 1);
    const int span = find_span(3, motion.tip.knots, time.t);
    std::array<double, 12> n;
    basis_derivatives(3, motion.tip.knots, span, time.t, 2, n.data());
    time.first = span - 3;
    std::copy_n(n.data(), 4, time.basis.data());
    std::copy_n(n.data() + 4, 4, time.basis_d1.data());
    // From second derivatives to second differences from sample to sample: what fairness weighs.
    const double h = 1.0 / (samples_t - 1);
    for (int k = 0; k < 4; ++k) time.basis_d2[k] = n[8 + k] * h * h;
    times_.push_back(time);
  }
  for (int j = 0; j < samples_s; ++j) s_.push_back(axis_length_ * j / (samples_s - 1));
}

AxisGrid::Pose AxisGrid::pose(const RuledMotion& motion, std::size_t i) const {
  const Time& time = times_[i];
  Pose pose;
  pose.tip.setZero();
  pose.w.setZero();
  for (int k = 0; k < 4; ++k) {
    pose.tip += time.basis[k] * motion.tip.poles.col(time.first + k);
    pose.w += time.basis[k] * motion.direction.poles.col(time.first + k);
  }
  pose.length_w = pose.w.norm();
  pose.u = pose.w / pose.length_w;
  return pose;
}

Vec6 AxisGrid::row(const Pose& pose, double s, const Vec3& gradient) const {
  Vec6 g;
  g.head<3>() = gradient;
  // u = w / |w|: du = (I - u u') dw / |w|, so only the part of the gradient across the axis turns it. The direction is scaled
  // by the axis length, so that all six coordinates are lengths and one damping fits them.
  g.tail<3>() = (s / (axis_length_ * pose.length_w)) * (gradient - gradient.dot(pose.u) * pose.u);
  return g;
}

}  // namespace flank::internal
