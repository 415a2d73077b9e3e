#include "flank/machine/engagement_feed.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flank::internal {

double chip_share(double engagement) { return std::sin(std::clamp(engagement, 0.0, 0.5 * std::numbers::pi)); }

double feed_at(double engagement, const EngagementFeed& rule) {
  if (!(rule.reference > 0.0)) return rule.feed;
  const double share = chip_share(engagement), wanted = rule.feed * chip_share(rule.reference);
  // Compared as products: in the air the share is nothing.
  return wanted >= rule.most_feed * share ? rule.most_feed : wanted / share;
}

double feed_between(std::span<const double> slowness, double from, double to, double even) {
  if (slowness.empty()) return even;
  const auto at = [&](double place) {
    const auto k = std::min(static_cast<std::size_t>(place), slowness.size() - 1);
    const std::size_t next = std::min(k + 1, slowness.size() - 1);
    return slowness[k] + (place - static_cast<double>(k)) * (slowness[next] - slowness[k]);
  };
  // Straight between the poses: the largest is at an end or at a pose.
  double largest = std::max(at(from), at(to));
  for (auto k = static_cast<std::size_t>(std::ceil(from)); static_cast<double>(k) <= to && k < slowness.size(); ++k)
    largest = std::max(largest, slowness[k]);
  return 1.0 / largest;
}

}  // namespace flank::internal
