#include "flank/envelope/swept_estimate.h"

#include <algorithm>
#include <cmath>

namespace flank {

namespace {
constexpr int kTable = 256;

double interpolate(const std::vector<double>& table, double x) {
  const int k = std::min(static_cast<int>(x), kTable - 1);
  const double f = x - k;
  return table[k] + f * (table[k + 1] - table[k]);
}
}  // namespace

SweptEstimate::SweptEstimate(const std::vector<RuledMotion>& motions, const RadialFunction& radial, int poses)
    : axis_length_(radial.axis_length()), per_length_(kTable / radial.axis_length()) {
  for (const RuledMotion& motion : motions) {
    std::vector<Pose>& table = poses_.emplace_back();
    for (int i = 0; i < poses; ++i) table.push_back(motion.pose(static_cast<double>(i) / (poses - 1)));
  }
  for (int k = 0; k <= kTable; ++k) {
    const RadialJet jet = radial.at(axis_length_ * k / kTable);
    radius_.push_back(jet.r);
    lean_.push_back(jet.d1 / std::sqrt(std::max(1e-6, 1.0 - jet.d1 * jet.d1)));
  }
}

double SweptEstimate::at_pose(const Pose& pose, const Vec3& x) const {
  const Vec3 q = x - pose.tip;
  const double z = q.dot(pose.axis);
  const double rho2 = std::max(0.0, q.squaredNorm() - z * z);
  const double rho = std::sqrt(rho2);
  double s = std::clamp(z, 0.0, axis_length_);
  for (int k = 0; k < 2; ++k) s = std::clamp(z + rho * interpolate(lean_, s * per_length_), 0.0, axis_length_);
  return std::sqrt(rho2 + (z - s) * (z - s)) - interpolate(radius_, s * per_length_);
}

double SweptEstimate::distance(const Vec3& x) const {
  double best = std::numeric_limits<double>::infinity();
  for (const std::vector<Pose>& poses : poses_) {
    std::size_t at = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const double f = at_pose(poses[i], x);
      if (f < least) {
        least = f;
        at = i;
      }
    }
    if (at > 0 && at + 1 < poses.size()) {
      const double a = at_pose(poses[at - 1], x), b = at_pose(poses[at + 1], x);
      const double bend = a + b - 2.0 * least;
      if (bend > 0.0) least -= (a - b) * (a - b) / (8.0 * bend);
    }
    best = std::min(best, least);
  }
  return best;
}

}  // namespace flank
