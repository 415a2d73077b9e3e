#include "flank/trochoid/engagement/ridge.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

/// Where a motion begins or ends only one line is known: the crest may be half way to its last time.
constexpr double kHalfWay = 0.5;

}  // namespace

Crest crest_of(const RingTimes& angles, double first, double step) {
  const auto most = static_cast<std::size_t>(std::max_element(angles.begin(), angles.end()) - angles.begin());
  Crest out{angles[most], first + static_cast<double>(most) * step};
  const double last = first + (kRidgeTimes - 1.0) * step;
  const auto raise = [&](double angle, double place) {
    if (angle > out.angle_rad) out = {angle, first + place * step};
  };
  // Between time k and the one after it.
  const auto meet = [&](std::size_t k) {
    const double rise = k > 0 ? angles[k] - angles[k - 1] : 0.0;
    const double fall = k + 2 < kRidgeTimes ? angles[k + 1] - angles[k + 2] : 0.0;
    const auto before = static_cast<double>(k);
    if (rise > 0.0 && fall > 0.0) {
      const double x = (angles[k + 1] - angles[k] + fall) / (rise + fall);
      if (x >= 0.0 && x <= 1.0) raise(angles[k] + rise * x, before + x);
    } else if (k == 0 && fall > 0.0 && first <= kFirstTime) {
      raise(angles[1] + kHalfWay * fall, before + kHalfWay);
    } else if (k + 2 == kRidgeTimes && rise > 0.0 && last > 1.0 - kFirstTime) {
      raise(angles[k] + kHalfWay * rise, before + kHalfWay);
    }
  };
  if (most > 0) meet(most - 1);
  if (most + 1 < kRidgeTimes) meet(most);
  return out;
}

std::vector<std::size_t> Ridge::tops() const {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < crests.size(); ++k) {
    const double here = crests[k].angle_rad;
    const bool over_last = k == 0 || here > crests[k - 1].angle_rad;
    const bool over_next = k + 1 == crests.size() || here >= crests[k + 1].angle_rad;
    if (here > 0.0 && over_last && over_next) out.push_back(k);
  }
  std::stable_sort(out.begin(), out.end(),
                   [&](std::size_t a, std::size_t b) { return crests[a].angle_rad > crests[b].angle_rad; });
  return out;
}

double Ridge::s_of(std::size_t ring) const {
  return std::lerp(window.s_low, window.s_high, static_cast<double>(ring) / (static_cast<double>(crests.size()) - 1.0));
}

RidgeWindow Ridge::around(std::size_t ring) const {
  constexpr double kSpare = 0.75, kFarthest = 8.0;  // of a step between times
  const double step = (window.t_high - window.t_low) / (kRidgeTimes - 1.0), here = crests[ring].t;
  const double apart = s_of(1) - s_of(0), s = s_of(ring);
  RidgeWindow out{here, here, s - apart, s + apart};
  for (std::size_t k = std::max<std::size_t>(ring, 1) - 1; k <= ring + 1 && k < crests.size(); ++k) {
    // A crest that is farther off is another ridge's.
    if (std::abs(crests[k].t - here) > kFarthest * step) continue;
    out.t_low = std::min(out.t_low, crests[k].t);
    out.t_high = std::max(out.t_high, crests[k].t);
  }
  out.t_low -= kSpare * step;
  out.t_high += kSpare * step;
  return out;
}

}  // namespace flank::internal
