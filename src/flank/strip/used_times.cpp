#include "flank/strip/used_times.h"

#include <algorithm>
#include <cmath>

#include "flank/base/parallel.h"
#include "flank/envelope/swept_estimate.h"

namespace flank::internal {
namespace {

constexpr int kPerSide = 120;  ///< places looked at, along a side of a target
constexpr int kPoses = 400;    ///< of a motion, tabulated
constexpr double kMore = 0.01;
/// Tolerances: contacts farther than this by the estimate are not refined, the estimate is better than that.
constexpr double kNear = 2.0;

std::vector<Vec3> places_on(const std::vector<const Target*>& targets) {
  std::vector<Vec3> places;
  for (const Target* target : targets) {
    const double spacing = std::sqrt(target->area()) / kPerSide;
    for (const SurfaceSample& sample : target->samples(spacing)) places.push_back(sample.point);
    for (const Vec3& point : target->border_points(spacing)) places.push_back(point);
  }
  return places;
}

}  // namespace

std::vector<TimeRange> used_times(const std::vector<RuledMotion>& motions, const RadialFunction& tool,
                                  const std::vector<const Target*>& targets, double tolerance_mm) {
  const std::vector<Vec3> places = places_on(targets);
  const SweptEstimate swept(motions, tool, kPoses);
  std::vector<SweptContact> contacts(places.size());
  parallel_for(places.size(), [&](std::size_t k) {
    contacts[k] = swept.nearest(places[k]);
    if (std::abs(contacts[k].f) > kNear * tolerance_mm) return;
    contacts[k] = swept.refine(places[k], contacts[k]);
  });
  std::vector<TimeRange> ranges(motions.size(), {2.0, -1.0});
  for (const SweptContact& contact : contacts) {
    if (contact.motion < 0 || std::abs(contact.f) > tolerance_mm) continue;
    TimeRange& range = ranges[static_cast<std::size_t>(contact.motion)];
    range.first = std::min(range.first, contact.t);
    range.last = std::max(range.last, contact.t);
  }
  for (TimeRange& range : ranges) {
    if (range.last < range.first) {
      range = {};
      continue;
    }
    const double more = kMore * (range.last - range.first);
    range = {std::max(0.0, range.first - more), std::min(1.0, range.last + more)};
  }
  return ranges;
}

}  // namespace flank::internal
