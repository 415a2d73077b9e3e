#include "flank/motion/motion_record.h"

#include <algorithm>

namespace flank::internal {
namespace {

/// Does what every evaluation of a rail takes for granted hold?
bool is_rail(const BSplineCurve3& rail) {
  const auto count = static_cast<std::size_t>(rail.count()), order = static_cast<std::size_t>(rail.degree) + 1;
  const std::vector<double>& knots = rail.knots;
  return count >= order && knots.size() == count + order && std::is_sorted(knots.begin(), knots.end()) &&
         knots.front() == 0.0 && knots[order - 1] == 0.0 && knots[count] == 1.0 && knots.back() == 1.0 &&
         rail.weights.empty();
}

void code(StepCodec& codec, BSplineCurve3& rail) {
  std::int64_t degree = rail.degree;
  codec.whole(degree, 1, kMaxDegree);
  rail.degree = static_cast<int>(degree);
  code(codec, rail.knots);
  const std::size_t count = codec.count(static_cast<std::size_t>(rail.count()));
  if (codec.reading()) rail.poles.resize(3, static_cast<Eigen::Index>(count));
  for (Eigen::Index k = 0; k < rail.poles.size(); ++k) codec.finite(rail.poles.data()[k]);
}

}  // namespace

void code(StepCodec& codec, RuledMotion& motion) {
  codec.finite(motion.axis_length);
  code(codec, motion.tip);
  code(codec, motion.direction);
  const bool empty = motion.tip.knots.empty() && motion.tip.count() == 0 && motion.direction.knots.empty() &&
                     motion.direction.count() == 0;
  codec.require(empty || (motion.axis_length > 0.0 && is_rail(motion.tip) && is_rail(motion.direction)),
                "expected an axis length > 0 and curves of tip and direction with clamped knots over [0, 1]");
}

}  // namespace flank::internal
