/// Feeds that follow the engagement, so that the thickest chip stays the same (docs/algorithms/machine.md, Feeds).
#pragma once

#include <span>

namespace flank::internal {

/// What the feed of a cut is about.
struct EngagementFeed {
  double feed = 1000.0 / 60.0;       ///< of the contact at the reference engagement, mm/s, > 0
  double reference = 0.0;            ///< radians, > 0; 0: the feed is `feed` everywhere
  double most_feed = 3000.0 / 60.0;  ///< where little or nothing is engaged, mm/s, > 0
};

/// The thickest chip of a tooth as a share of the feed per tooth: sin(engagement) up to 90 degrees, 1 beyond. It is that
/// of an arc which begins or ends at the edge of the front, as in side milling: with a radial depth a of a tool of
/// radius R, cos(engagement) = 1 - a / R and sin(engagement) = sqrt(1 - (1 - a / R)^2), the shops' formula.
[[nodiscard]] double chip_share(double engagement);

/// The contact's feed at an engagement, mm/s: feed chip_share(reference) / chip_share(engagement), at most most_feed.
[[nodiscard]] double feed_at(double engagement, const EngagementFeed& rule);

/// The slowest feed on the way between two places of a strip, pose index and fraction, from <= to. `slowness`: of each pose the
/// least time for a mm, s, which runs straight between them; empty: the feed is `even`. mm/s.
[[nodiscard]] double feed_between(std::span<const double> slowness, double from, double to, double even);

}  // namespace flank::internal
