#include "flank/seed/direction/seeds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/base/assert.h"
#include "flank/seed/direction/direction_filter.h"

namespace flank::internal {
namespace {

/// Pairs s, L - s at which the two ends of a tool are compared, over half the axis.
constexpr int kSymmetryPairs = 16;
/// Of the axis length: radii that differ by less are equal. Round-off is 1e-16 of it; no real tool is this nearly
/// symmetric.
constexpr double kSameRadius = 1e-9;
/// Cosine of the angle at which two directions count as opposite: within sqrt(2e-6) = 0.08 degrees. Roots come in such
/// pairs up to round-off.
constexpr double kOpposite = -1.0 + 1e-6;

}  // namespace

Pose seed_pose(const LineSeed& seed, const RadialFunction& radial) {
  const RadialJet jet = radial.at(seed.s);
  const Vec3 axis = (jet.d1 * seed.normal + std::sqrt(1.0 - jet.d1 * jet.d1) * seed.direction).normalized();
  return {seed.point + jet.r * seed.normal - seed.s * axis, axis};
}

bool is_symmetric(const RadialFunction& radial) {
  const double length = radial.axis_length();
  for (int j = 0; j <= kSymmetryPairs; ++j) {
    const double s = length * j / (2.0 * kSymmetryPairs);
    if (std::abs(radial.at(s).r - radial.at(length - s).r) > kSameRadius * length) return false;
  }
  return true;
}

std::vector<Vec3> seed_directions(const Vec3& normal, const RadialFunction& radial, int directions) {
  FLANK_ASSERT(directions >= 1);
  const bool half = is_symmetric(radial);
  const int count = half ? directions : 2 * directions;
  const double step = (half ? 1.0 : 2.0) * std::numbers::pi / count;
  const Vec3 a = normal.unitOrthogonal(), b = normal.cross(a);
  std::vector<Vec3> result;
  for (int k = 0; k < count; ++k) result.push_back(std::cos(k * step) * a + std::sin(k * step) * b);
  return result;
}

std::vector<SurfaceSample> grid_places(const Target& target, int count) {
  return target.samples(std::sqrt(target.area() / count));
}

std::vector<LineSeed> even_seeds(const std::vector<SurfaceSample>& places, const RadialFunction& radial,
                                 int directions) {
  std::vector<LineSeed> seeds;
  for (const SurfaceSample& place : places)
    for (const Vec3& direction : seed_directions(place.normal, radial, directions))
      seeds.push_back({place.point, place.normal, direction, 0.5 * radial.axis_length()});
  return seeds;
}

std::vector<LineSeed> admissible_seeds(const Target& target, const std::vector<SurfaceSample>& places,
                                       const RadialFunction& radial, int spheres, double tolerance_mm) {
  DirectionFilterOptions options;
  options.tolerance_mm = tolerance_mm;
  // A tool longer than the target hangs over: what is beyond the border need not touch.
  options.contact_length_mm = std::min(radial.axis_length(), target.diagonal());
  const bool half = is_symmetric(radial);
  std::vector<LineSeed> seeds;
  for (const SurfaceSample& place : places) {
    const Footpoint foot = target.closest(place.point);
    for (int j = 0; j < spheres; ++j) {
      // Middles of equal pieces: the ends of the axis would see the target on one side only.
      const double s = (j + 0.5) / spheres * radial.axis_length();
      const CandidateDirections found = candidate_directions(foot, radial.at(s), options);
      std::vector<Vec3> taken;
      for (const Vec3& axis : found.all()) {
        const Vec3 direction = (axis - axis.dot(foot.normal) * foot.normal).normalized();
        // A tool with equal ends turned round is the same line, from the other sphere.
        const bool known = half && std::any_of(taken.begin(), taken.end(),
                                               [&](const Vec3& d) { return d.dot(direction) < kOpposite; });
        if (known) continue;
        taken.push_back(direction);
        seeds.push_back({foot.point, foot.normal, direction, s});
      }
    }
  }
  return seeds;
}

}  // namespace flank::internal
