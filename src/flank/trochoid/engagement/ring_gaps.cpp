#include "flank/trochoid/engagement/ring_gaps.h"

#include <cmath>
#include <numbers>

namespace flank::internal {
namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

void RingGaps::open(double half, double x, double y) {
  gaps_.push_back({-half, half, {}, {}, Vec2(x, -y), Vec2(x, y), {-half, half}});
}

bool RingGaps::cut(double low, double high, const GapBound& bound) {
  cut_.clear();
  bool changed = false;
  for (const RingGap& gap : gaps_) {
    RingGap rest = gap;
    bool left = true;
    for (const double turn : {-2.0 * kPi, 0.0, 2.0 * kPi}) {
      const double from = low + turn, to = high + turn;
      if (!left || to <= rest.low || from >= rest.high) continue;
      changed = true;
      if (from > rest.low) {
        RingGap before = rest;
        before.high = from;
        before.at_high = bound;
        before.to = Vec2(std::cos(from), std::sin(from));
        if (before.is_some()) cut_.push_back(before);
      }
      left = to < rest.high;
      if (!left) continue;
      rest.low = to;
      rest.at_low = bound;
      rest.from = Vec2(std::cos(to), std::sin(to));
    }
    if (left && rest.is_some()) cut_.push_back(rest);
  }
  gaps_.swap(cut_);
  return changed;
}

void RingGaps::go_beyond() {
  constexpr double kBeyond = 0.03;  // radians
  for (RingGap& gap : gaps_) {
    gap.limits = {gap.low, gap.high};
    gap.low -= kBeyond;
    gap.high += kBeyond;
    gap.from = Vec2(std::cos(gap.low), std::sin(gap.low));
    gap.to = Vec2(std::cos(gap.high), std::sin(gap.high));
  }
}

bool RingGaps::reached_by(double ring, const Vec2& middle, double disc2) const {
  return std::any_of(gaps_.begin(), gaps_.end(), [&](const RingGap& gap) {
    return (ring * gap.from - middle).squaredNorm() < disc2 || (ring * gap.to - middle).squaredNorm() < disc2 ||
           gap.high - gap.low > kWide ||
           (gap.from.x() * middle.y() - gap.from.y() * middle.x() > 0.0 &&
            middle.x() * gap.to.y() - middle.y() * gap.to.x() > 0.0);
  });
}

void RingGaps::arcs(double ring, const Vec2& motion, std::vector<OpenArc>& out) const {
  const auto turned = [&](const Vec2& v) {
    return Vec2(motion.x() * v.x() - motion.y() * v.y(), motion.y() * v.x() + motion.x() * v.y());
  };
  out.clear();
  for (const RingGap& gap : gaps_)
    out.push_back({ring * turned(gap.from), ring * turned(gap.to), gap.high - gap.low > kWide});
}

}  // namespace flank::internal
