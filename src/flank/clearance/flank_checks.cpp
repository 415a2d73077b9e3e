#include "flank/clearance/flank_checks.h"

#include <algorithm>
#include <cmath>

#include "flank/base/parallel.h"

namespace flank {
namespace {

constexpr int kVoters = 400;
constexpr double kMajority = 0.55;  ///< a blade that is buried in its hub for a third still sees the hub from outside

/// Which way a face must be turned so that the target's machining side is outside of it; 0 if that is not clear.
int vote(const CheckFace& face, const std::vector<SurfaceSample>& samples, double offset_mm) {
  double outside = 0.0, all = 0.0;
  for (const SurfaceSample& sample : samples) {
    const Footpoint foot = face.surface->closest(sample.point + offset_mm * sample.normal);
    if (foot.location != Location::kInside) continue;
    all += sample.area;
    if (foot.distance > 0.0) outside += sample.area;
  }
  if (all == 0.0) return 0;
  if (outside >= kMajority * all) return +1;
  return !face.oriented && outside <= (1.0 - kMajority) * all ? -1 : 0;
}

}  // namespace

FlankChecks::FlankChecks(std::vector<CheckFace> faces, const Target& target, double offset_mm)
    : faces_(std::move(faces)), signs_(faces_.size(), 0) {
  const std::vector<SurfaceSample> samples = target.samples(std::sqrt(target.area() / kVoters));
  parallel_for(faces_.size(), [&](std::size_t k) { signs_[k] = vote(faces_[k], samples, offset_mm); });
}

bool FlankChecks::reachable(const SurfaceSample& sample, double radius_mm, double depth_mm) const {
  return at(sample.point + radius_mm * sample.normal, radius_mm).distance_mm >= radius_mm - depth_mm;
}

CheckDistance FlankChecks::at(const Vec3& p, double horizon_mm) const {
  CheckDistance nearest;
  nearest.distance_mm = horizon_mm;
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const double box = faces_[k].surface->box().squared_distance(p);
    if (box > 0.0 && (nearest.distance_mm <= 0.0 || box >= nearest.distance_mm * nearest.distance_mm)) continue;
    const Footpoint foot = faces_[k].surface->closest(p);
    const Vec3 away = p - foot.point;
    const double length = away.norm();
    double distance = length;
    if (foot.location == Location::kInside && signs_[k] != 0) distance = signs_[k] * foot.distance;
    if (distance >= nearest.distance_mm) continue;
    nearest.distance_mm = distance;
    nearest.face = static_cast<int>(k);
    if (length > 1e-9) {
      nearest.gradient = (distance < 0.0 ? -1.0 : 1.0) / length * away;
    } else {
      nearest.gradient = (signs_[k] < 0 ? -1.0 : 1.0) * foot.normal;
    }
  }
  return nearest;
}

}  // namespace flank
