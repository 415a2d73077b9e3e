#include "flank/trochoid/engagement/row_cuts.h"

namespace flank::internal {

bool cut_gaps(std::vector<FrontGap>& gaps, std::vector<FrontGap>& scratch, double low, double high,
              const GapBound& bound) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  scratch.clear();
  bool changed = false;
  for (const FrontGap& gap : gaps) {
    FrontGap rest = gap;
    bool left = true;
    for (const double turn : {-kTurn, 0.0, kTurn}) {
      const double from = low + turn, to = high + turn;
      if (!left || to <= rest.low || from >= rest.high) continue;
      changed = true;
      if (from > rest.low) {
        FrontGap before = rest;
        before.high = from;
        before.at_high = bound;
        before.to = Vec2(std::cos(from), std::sin(from));
        if (before.is_some()) scratch.push_back(before);
      }
      left = to < rest.high;
      if (!left) continue;
      rest.low = to;
      rest.at_low = bound;
      rest.from = Vec2(std::cos(to), std::sin(to));
    }
    if (left && rest.is_some()) scratch.push_back(rest);
  }
  gaps.swap(scratch);
  return changed;
}

void go_beyond(std::vector<FrontGap>& gaps) {
  constexpr double kBeyond = 0.03;  // radians
  for (FrontGap& gap : gaps) {
    gap.limits = {gap.low, gap.high};
    gap.low -= kBeyond;
    gap.high += kBeyond;
    gap.from = Vec2(std::cos(gap.low), std::sin(gap.low));
    gap.to = Vec2(std::cos(gap.high), std::sin(gap.high));
  }
}

void open_arcs(const std::vector<FrontGap>& gaps, double radius, const Vec2& motion, std::vector<OpenArc>& out) {
  const auto turned = [&](const Vec2& v) {
    return Vec2(motion.x() * v.x() - motion.y() * v.y(), motion.y() * v.x() + motion.x() * v.y());
  };
  out.clear();
  for (const FrontGap& gap : gaps)
    out.push_back({radius * turned(gap.from), radius * turned(gap.to), gap.high - gap.low > kWide});
}

}  // namespace flank::internal
