#include "flank/cover/seeds.h"

#include <cmath>
#include <numbers>

namespace flank {

Pose seed_pose(const LineSeed& seed, const RadialFunction& radial) {
  const RadialJet jet = radial.at(seed.s);
  const Vec3 axis = (jet.d1 * seed.normal + std::sqrt(1.0 - jet.d1 * jet.d1) * seed.direction).normalized();
  return {seed.point + jet.r * seed.normal - seed.s * axis, axis};
}

bool is_symmetric(const RadialFunction& radial) {
  const double length = radial.axis_length();
  for (int j = 0; j <= 16; ++j) {
    const double s = length * j / 32.0;
    if (std::abs(radial.at(s).r - radial.at(length - s).r) > 1e-9 * length) return false;
  }
  return true;
}

std::vector<Vec3> seed_directions(const Vec3& normal, const RadialFunction& radial, int directions) {
  const bool half = is_symmetric(radial);
  const int count = half ? directions : 2 * directions;
  const double step = (half ? 1.0 : 2.0) * std::numbers::pi / count;
  const Vec3 a = normal.unitOrthogonal(), b = normal.cross(a);
  std::vector<Vec3> result;
  for (int k = 0; k < count; ++k) result.push_back(std::cos(k * step) * a + std::sin(k * step) * b);
  return result;
}

std::vector<LineSeed> grid_seeds(const Target& target, const RadialFunction& radial, int places, int directions) {
  std::vector<LineSeed> seeds;
  for (const SurfaceSample& sample : target.samples(std::sqrt(target.area() / places)))
    for (const Vec3& direction : seed_directions(sample.normal, radial, directions))
      seeds.push_back({sample.point, sample.normal, direction, 0.5 * radial.axis_length()});
  return seeds;
}

}  // namespace flank
