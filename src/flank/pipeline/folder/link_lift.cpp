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
/// None, then straight ways round the axis, then arcs.
constexpr std::size_t kStraight = kDirections * kShares.size() + 1, kWays = 2 * kStraight - 1;
constexpr double kNoWay = -1e300;  ///< in the place of a distance

/// The least distance from the samples on the second half of the lead and on the way along the axis, up to `enough`. On
/// the first half the tool is where it has just cut.
double least_distance(const Tool& tool, const StripEnd& end, const Lead& lead, const std::vector<FaceSamples>& samples,
                      double run_mm, double enough) {
  const std::vector<Pose> out = lead_out(end.contact, lead);
  Strip strip{1, "link", "", {}};
  if (out.size() == 2) strip.poses.push_back({0.5 * (out[0].tip + out[1].tip), out[0].axis});
  strip.poses.insert(strip.poses.end(), out.begin() + static_cast<std::ptrdiff_t>(out.size() / 2), out.end());
  const Pose& last = out.back();
  strip.poses.push_back({last.tip + run_mm * last.axis, last.axis});
  Path path;
  path.strips.push_back(std::move(strip));
  const SweptVolume volume(tool, path);
  double least = enough;
  for (const FaceSamples& face : samples)
    for (const Vec3& p : face.points) least = std::min(least, volume.distance(p, least).f);
  return least;
}

/// The k-th lead; nothing that is off the surface for an arc whose plane the motion leaves.
Lead lead_of(const StripEnd& end, std::size_t k, double lift_mm) {
  if (k == 0) return {};
  const bool arc = k >= kStraight;
  const std::size_t way = (arc ? k - kStraight : k - 1);
  const Vec3& axis = end.contact.axis;
  const Vec3 side = axis.unitOrthogonal(), other = axis.cross(side);
  const double angle = 2.0 * std::numbers::pi * static_cast<double>(way % kDirections) / kDirections;
  const Vec3 off = std::cos(angle) * side + std::sin(angle) * other;
  Lead lead{kShares[way / kDirections] * lift_mm * off, Vec3::Zero()};
  if (!arc) return lead;
  constexpr double kAcross = 0.5;  // of the motion across `off`: an arc away from where it was going is no tangent one
  const Vec3 along = end.going - off.dot(end.going) * off;
  if (!(along.norm() > kAcross * end.going.norm())) return {};
  lead.along = along.normalized();
  return lead;
}

/// Those that there are, the best first.
std::vector<std::size_t> best_first(const double* distances) {
  const double *arcs = distances + kStraight, *end = distances + kWays;
  const double straight = *std::max_element(distances, arcs), arc = *std::max_element(arcs, end);
  const bool tangent = arc > 0.0 && arc >= 0.5 * straight;
  std::vector<std::size_t> ways;
  for (std::size_t k = 0; k < kWays; ++k)
    if (distances[k] != kNoWay) ways.push_back(k);
  std::stable_sort(ways.begin(), ways.end(), [&](std::size_t a, std::size_t b) {
    const bool arc_a = a >= kStraight, arc_b = b >= kStraight;
    return arc_a != arc_b ? arc_a == tangent : distances[a] > distances[b];
  });
  return ways;
}

}  // namespace

LeadSearch::LeadSearch(const Tool& tool, std::vector<StripEnd> ends, const std::vector<FaceSamples>& samples,
                       double lift_mm, double run_mm)
    : ends_(std::move(ends)), lift_mm_(lift_mm), chosen_(ends_.size(), 0) {
  std::vector<double> distances(ends_.size() * kWays);
  parallel_for(distances.size(), [&](std::size_t i) {
    const StripEnd& end = ends_[i / kWays];
    const Lead lead = lead_of(end, i % kWays, lift_mm);
    const bool no_arc = i % kWays >= kStraight && lead.along.isZero();
    distances[i] = no_arc ? kNoWay : least_distance(tool, end, lead, samples, run_mm, 2.0 * lift_mm);
  });
  for (std::size_t e = 0; e < ends_.size(); ++e) ways_.push_back(best_first(distances.data() + e * kWays));
}

Lead LeadSearch::lead(std::size_t end) const { return lead_of(ends_[end], ways_[end][chosen_[end]], lift_mm_); }

bool LeadSearch::next(std::size_t end) {
  if (chosen_[end] + 1 >= ways_[end].size()) return false;
  ++chosen_[end];
  return true;
}

}  // namespace flank::internal
