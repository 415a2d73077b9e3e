#include "flank/trochoid/sides/axial_ends.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "flank/motion/motion_part.h"

namespace flank::internal {
namespace {

constexpr int kSteps = 256;
constexpr double kAlong = 0.5 * std::numbers::sqrt2;  ///< cosine of 45 degrees
/// Of the way: what is axial for longer, and what is too short to matter.
constexpr double kMostAxial = 0.25, kLeastAxial = 0.01;

}  // namespace

RuledMotion without_axial_ends(const RuledMotion& motion) {
  const double middle = 0.5 * motion.axis_length;
  std::vector<bool> axial;
  std::vector<double> way;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const AxisJet axis = motion.jet((i + 0.5) / kSteps);
    const Vec3 velocity = axis.velocity(middle);
    axial.push_back(std::abs(velocity.dot(axis.u)) > kAlong * velocity.norm());
    way.push_back(velocity.norm());
    sum += way.back();
  }
  // From an end on, how many steps are axial; none if that is hardly any, or most, of the way.
  const auto steps = [&](bool from_end) {
    double length = 0.0;
    int count = 0;
    for (; count < kSteps; ++count) {
      const auto i = static_cast<std::size_t>(from_end ? kSteps - 1 - count : count);
      if (!axial[i]) break;
      length += way[i];
    }
    return length >= kLeastAxial * sum && length <= kMostAxial * sum ? count : 0;
  };
  const int first = steps(false), last = kSteps - steps(true);
  if (first == 0 && last == kSteps) return motion;
  return motion_part(motion, static_cast<double>(first) / kSteps, static_cast<double>(last) / kSteps);
}

}  // namespace flank::internal
