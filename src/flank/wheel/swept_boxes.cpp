#include "flank/wheel/swept_boxes.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

constexpr std::size_t kPoses = 12;  ///< of a box
constexpr int kBalls = 17;          ///< of the flank
constexpr double kMarginMm = 1e-3;

}  // namespace

SweptBoxes::SweptBoxes(const Path& path, const RadialFunction& radial) {
  const double length = radial.axis_length();
  // Between two balls the flank is no wider than their hull and what the radius bends.
  double bend = 0.0;
  for (int k = 0; k < kBalls; ++k) bend = std::max(bend, std::abs(radial.at(length * k / (kBalls - 1.0)).d2));
  const double step = length / (kBalls - 1.0), swell = bend * step * step / 8.0 + kMarginMm;
  for (const Strip& strip : path.strips)
    for (std::size_t from = 0; from < strip.poses.size(); from += kPoses) {
      Box3 box;
      double turn = 0.0;
      const std::size_t to = std::min(strip.poses.size() - 1, from + kPoses);
      for (std::size_t i = from; i <= to; ++i) {
        const Pose& pose = strip.poses[i];
        if (i > from) turn = std::max(turn, (pose.axis - strip.poses[i - 1].axis).norm());
        for (int k = 0; k < kBalls; ++k) {
          const double s = step * k;
          box.add(pose.at(s) - Vec3::Constant(radial.at(s).r));
          box.add(pose.at(s) + Vec3::Constant(radial.at(s).r));
        }
      }
      // The axis turns along an arc beyond its chord.
      const double margin = swell + length * turn * turn / 4.0;
      box.low.array() -= margin, box.high.array() += margin;
      boxes_.push_back(box);
    }
}

bool SweptBoxes::meet(const Box3& box) const {
  return std::any_of(boxes_.begin(), boxes_.end(), [&](const Box3& one) {
    return (one.low.array() <= box.high.array()).all() && (box.low.array() <= one.high.array()).all();
  });
}

}  // namespace flank::internal
