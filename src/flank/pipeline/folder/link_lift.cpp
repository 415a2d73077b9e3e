#include "flank/pipeline/folder/link_lift.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "flank/base/parallel.h"

namespace flank::internal {
namespace {

constexpr std::size_t kDirections = 16;
/// Of the lift: where there is no room for all of it.
constexpr std::array<double, 2> kShares{1.0, 0.25};
constexpr std::size_t kWays = kDirections * kShares.size() + 1;

/// The least distance from the samples on the second half of the way off and on the way along the axis, up to `enough`.
double least_distance(const Tool& tool, const Pose& contact, const Vec3& lift, const std::vector<FaceSamples>& samples,
                      double run_mm, double enough) {
  const Vec3& axis = contact.axis;
  const Vec3 off = contact.tip + lift;
  Path path;
  path.strips.push_back({1, "link", "", {{contact.tip + 0.5 * lift, axis}, {off, axis}, {off + run_mm * axis, axis}}});
  const SweptVolume volume(tool, path);
  double least = enough;
  for (const FaceSamples& face : samples)
    for (const Vec3& p : face.points) least = std::min(least, volume.distance(p, least).f);
  return least;
}

/// The k-th way off: none, then round the axis, then the same, shorter.
Vec3 way_off(const Pose& contact, std::size_t k, double lift_mm) {
  if (k == 0) return Vec3::Zero();
  const Vec3 side = contact.axis.unitOrthogonal(), other = contact.axis.cross(side);
  const double angle = 2.0 * std::numbers::pi * static_cast<double>((k - 1) % kDirections) / kDirections;
  return kShares[(k - 1) / kDirections] * lift_mm * (std::cos(angle) * side + std::sin(angle) * other);
}

}  // namespace

std::vector<Vec3> lifts_off(const Tool& tool, const std::vector<Pose>& poses, const std::vector<FaceSamples>& samples,
                            double lift_mm, double run_mm) {
  std::vector<double> distances(poses.size() * kWays);
  parallel_for(distances.size(), [&](std::size_t i) {
    const Pose& contact = poses[i / kWays];
    distances[i] = least_distance(tool, contact, way_off(contact, i % kWays, lift_mm), samples, run_mm, 2.0 * lift_mm);
  });
  std::vector<Vec3> ways;
  for (std::size_t pose = 0; pose < poses.size(); ++pose) {
    const auto begin = distances.begin() + static_cast<std::ptrdiff_t>(pose * kWays);
    const auto best = static_cast<std::size_t>(std::max_element(begin, begin + kWays) - begin);
    ways.push_back(way_off(poses[pose], best, lift_mm));
  }
  return ways;
}

}  // namespace flank::internal
