#include "flank/tour/levels.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

/// Part of a stretch, as a stretch.
TourStretch part(const TourStretch& whole, double from, double to) {
  return [whole, from, to](double share, double foot_s) { return whole(from + share * (to - from), foot_s); };
}

double length_of(const TourStretch& stretch, double foot_s, double axis_length_mm) {
  return way_of([&](double share) { return stretch(share, foot_s); }, axis_length_mm);
}

/// From 0 to 1 without a corner at either end.
double eased(double x) { return x * x * (3.0 - 2.0 * x); }

/// The longest stretch is cut in its middle, and the round begins there.
std::vector<TourStretch> from_the_middle(const std::vector<TourStretch>& stretches, double foot_s, double length) {
  std::size_t longest = 0;
  double most = 0.0;
  for (std::size_t k = 0; k < stretches.size(); ++k)
    if (const double way = length_of(stretches[k], foot_s, length); way > most) {
      most = way;
      longest = k;
    }
  std::vector<TourStretch> round{part(stretches[longest], 0.5, 1.0)};
  for (std::size_t k = 1; k < stretches.size(); ++k) round.push_back(stretches[(longest + k) % stretches.size()]);
  round.push_back(part(stretches[longest], 0.0, 0.5));
  return round;
}

}  // namespace

Heights heights_of(double lowest_foot_s, double over_mm, const std::optional<double>& axis_length_mm) {
  constexpr double kAbove = 0.02, kOverlap = 0.05;  // of the axis over the walls, of the flank
  const double needed = lowest_foot_s + (1.0 + kAbove) * over_mm;
  if (!axis_length_mm) return {needed, {lowest_foot_s}};
  const double length = *axis_length_mm, highest = lowest_foot_s - (needed - length);
  if (highest >= lowest_foot_s) return {length, {lowest_foot_s}};
  const int steps = static_cast<int>(std::ceil((lowest_foot_s - highest) / ((1.0 - kOverlap) * length)));
  Heights heights{length, {}};
  for (int k = 0; k <= steps; ++k) heights.foot_s.push_back(highest + (lowest_foot_s - highest) * k / steps);
  return heights;
}

std::vector<Leg> round_in_levels(const std::vector<TourStretch>& stretches, const std::vector<double>& levels,
                                 double axis_length_mm) {
  constexpr double kGentle = 4.0;  // ways to sink by one
  const std::vector<TourStretch> round = from_the_middle(stretches, levels.front(), axis_length_mm);
  std::vector<Leg> legs;
  std::size_t here = 0;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const double foot_s = levels[level];
    if (level > 0) {
      const double above = levels[level - 1], sinks = foot_s - above;
      std::vector<TourStretch> ramp;
      std::vector<double> ends{0.0};
      while (ramp.size() < round.size() && ends.back() < kGentle * sinks) {
        ramp.push_back(round[(here + ramp.size()) % round.size()]);
        ends.push_back(ends.back() + length_of(ramp.back(), foot_s, axis_length_mm));
      }
      for (std::size_t k = 0; k < ramp.size(); ++k)
        legs.push_back([stretch = ramp[k], above, sinks, from = ends[k] / ends.back(), to = ends[k + 1] / ends.back()](
                           double share) { return stretch(share, above + sinks * eased(from + share * (to - from))); });
      here = (here + ramp.size()) % round.size();
    }
    for (std::size_t k = 0; k < round.size(); ++k)
      legs.push_back(
          [stretch = round[(here + k) % round.size()], foot_s](double share) { return stretch(share, foot_s); });
  }
  return legs;
}

}  // namespace flank::internal
