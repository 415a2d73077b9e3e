#include "flank/pipeline/cut_direction.h"

#include <algorithm>

#include "flank/strip/strip_order.h"

namespace flank::internal {
namespace {

constexpr int kPlaces = 17;  // of a motion

}  // namespace

double climb_share(const RuledMotion& motion, const Target& target) {
  double climbs = 0.0, way = 0.0;
  for (int k = 0; k < kPlaces; ++k) {
    // Not at its ends, where a motion may be beyond the target.
    const AxisJet jet = motion.jet((k + 0.5) / kPlaces);
    const Vec3 middle = jet.at(0.5 * motion.axis_length), velocity = jet.velocity(0.5 * motion.axis_length);
    const Vec3 off = middle - target.closest(middle).point;
    // The edge runs along u x n where the tool touches with the outward normal n of the face: clockwise seen from the holder.
    const Vec3 edge = jet.u.cross(off);
    if (!(edge.norm() > 0.0)) continue;
    climbs -= edge.normalized().dot(velocity);
    way += velocity.norm();
  }
  return way > 0.0 ? climbs / way : 0.0;
}

void run_as(const std::string& cut, std::vector<RuledMotion>& motions, std::vector<const TargetGroup*>& groups) {
  const double wanted = cut == "climb" ? 1.0 : -1.0;
  std::size_t turned = 0;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    if (!(wanted * climb_share(motions[k], *groups[k]->target) < 0.0)) continue;
    motions[k] = reversed(motions[k]);
    ++turned;
  }
  if (turned == 0 || turned < motions.size()) return;
  std::reverse(motions.begin(), motions.end());
  std::reverse(groups.begin(), groups.end());
}

}  // namespace flank::internal
