#include "flank/path/pose_velocity.h"

#include <algorithm>

namespace flank::internal {

double way_between(const Pose& a, const Pose& b, double length) {
  return std::max((b.tip - a.tip).norm(), (b.at(length) - a.at(length)).norm());
}

PoseVelocity velocity_at(std::span<const Pose> poses, std::size_t k, double length) {
  PoseVelocity out;
  for (std::size_t n = std::max<std::size_t>(k, 1); n <= std::min(k + 1, poses.size() - 1); ++n) {
    const double way = way_between(poses[n - 1], poses[n], length);
    if (!(way > 0.0)) continue;
    // The shorter way tells more of the direction here.
    const double weight = 1.0 / (way * way);
    out.tip += weight * (poses[n].tip - poses[n - 1].tip);
    out.axis += weight * (poses[n].axis - poses[n - 1].axis);
  }
  // Of one length, so that there is a mean of two.
  const double fastest = std::max(out.tip.norm(), out.at(length).norm());
  return fastest > 0.0 ? PoseVelocity{out.tip / fastest, out.axis / fastest} : out;
}

}  // namespace flank::internal
