#include "flank/example/example_perturb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace flank::internal {
namespace {

constexpr int kPoses = 201;
constexpr int kLeastControlPoints = 12;

/// A vector that varies slowly over t in [0, 1]: half a period and one period at most.
struct SlowVector {
  std::array<Vec3, 3> amplitude;
  [[nodiscard]] Vec3 at(double t) const {
    constexpr double kPi = 3.14159265358979323846;
    return amplitude[0] + std::cos(kPi * t) * amplitude[1] + std::cos(2.0 * kPi * t) * amplitude[2];
  }
};

SlowVector random_slow_vector(Random& random) {
  SlowVector v;
  for (std::size_t k = 0; k < v.amplitude.size(); ++k) {
    const double share = 1.0 / static_cast<double>(k + 1);
    for (int c = 0; c < 3; ++c) v.amplitude[k][c] = share * random.normal();
  }
  return v;
}

/// The pose shifted, and turned about mid-axis by |turn| about turn.
Pose moved(const Pose& pose, double axis_length, const Vec3& shift, const Vec3& turn) {
  const Vec3 middle = pose.at(0.5 * axis_length) + shift;
  const double angle = turn.norm();
  const Vec3 u = angle > 0.0 ? Vec3(Eigen::AngleAxisd(angle, turn / angle) * pose.axis) : pose.axis;
  return {middle - 0.5 * axis_length * u, u};
}

}  // namespace

RuledMotion perturb(const RuledMotion& motion, double relative, double diagonal_mm, Random& random) {
  const SlowVector shift = random_slow_vector(random), turn = random_slow_vector(random);
  const double half = 0.5 * motion.axis_length;
  std::vector<double> t;
  double largest =
      0.0;  // displacement of an end of the axis, to first order, before scaling; `turn` is in mm at the ends
  for (int i = 0; i < kPoses; ++i) {
    t.push_back(static_cast<double>(i) / (kPoses - 1));
    const Vec3 swing = turn.at(t.back()).cross(motion.pose(t.back()).axis);
    largest = std::max({largest, (shift.at(t.back()) + swing).norm(), (shift.at(t.back()) - swing).norm()});
  }
  const double scale = relative * diagonal_mm / largest;
  std::vector<Pose> poses;
  for (const double x : t)
    poses.push_back(moved(motion.pose(x), motion.axis_length, scale * shift.at(x), scale / half * turn.at(x)));
  return fit_motion(poses, t, motion.axis_length, std::max(motion.tip.count(), kLeastControlPoints));
}

}  // namespace flank::internal
