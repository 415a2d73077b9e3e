#include "flank/motion/stagger.h"

#include <cmath>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

/// Of a motion, at the middles of as many stretches.
constexpr int kTimes = 9;

}  // namespace

double stagger(const RuledMotion& left, const RuledMotion& right) {
  double sum = 0.0;
  for (int i = 0; i < kTimes; ++i) {
    const double t = (i + 0.5) / kTimes, middle = 0.5 * left.axis_length;
    const AxisJet a = left.jet(t), b = right.jet(t);
    const Vec3 forward = (a.velocity(middle).normalized() + b.velocity(middle).normalized()).normalized();
    sum += 0.5 * std::abs((a.u - b.u).dot(forward));
  }
  return sum / kTimes;
}

double mean_stagger(std::span<const RuledMotion> motions) {
  FLANK_ASSERT(motions.size() % 2 == 0 && !motions.empty());
  double sum = 0.0;
  for (std::size_t k = 0; k < motions.size(); k += 2) sum += stagger(motions[k], motions[k + 1]);
  return 2.0 * sum / static_cast<double>(motions.size());
}

double mean_lean(std::span<const RuledMotion> motions) {
  double sum = 0.0;
  for (const RuledMotion& motion : motions) {
    for (int i = 0; i < kTimes; ++i) {
      const AxisJet axis = motion.jet((i + 0.5) / kTimes);
      const Vec3 way = axis.velocity(0.5 * motion.axis_length).normalized();
      sum += std::abs(axis.u.dot(way)) / kTimes;
    }
  }
  return motions.empty() ? 0.0 : sum / static_cast<double>(motions.size());
}

}  // namespace flank::internal
