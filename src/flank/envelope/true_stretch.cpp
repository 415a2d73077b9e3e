#include "flank/envelope/true_stretch.h"

#include <algorithm>
#include <vector>

#include "flank/base/parallel.h"
#include "flank/geom/spline_segment.h"

namespace flank::internal {
namespace {

constexpr int kPosesForEachPole = 8;

/// The curve from one time to another, over [0, 1].
BSplineCurve3 part_of(const BSplineCurve3& curve, double from, double to) {
  SplineRows rows = spline_segment({curve.degree, curve.knots, curve.poles}, from, to);
  const double first = rows.first(), last = rows.last();
  BSplineCurve3 out;
  out.degree = rows.degree;
  for (const double knot : rows.knots) out.knots.push_back((knot - first) / (last - first));
  out.poles = rows.poles;
  return out;
}

RuledMotion part_of(const RuledMotion& motion, double from, double to) {
  return {motion.axis_length, part_of(motion.tip, from, to), part_of(motion.direction, from, to)};
}

}  // namespace

ExactStrip::ExactStrip(const StripMotion& strip, const RadialFunction& radial)
    : motion_(part_of(strip.motion, strip.from_t, strip.to_t)),
      radial_(radial),
      side_(strip.side),
      swept_({motion_}, radial, kPosesForEachPole * std::max(motion_.tip.count(), motion_.direction.count())) {}

ContactPoint ExactStrip::contact(double u, double v) const {
  const double s = radial_.axis_length() * v;
  return contact_point(jet(u), radial_.at(s), s, side_);
}

bool ExactStrip::is_left(double u, double v, double limit_mm) const {
  const ContactPoint here = contact(u, v);
  if (!here.exists) return false;
  const SweptContact nearest = swept_.nearest(here.point);
  // The estimate is off by more than that where the motion is quick: only what it doubts is asked for in full.
  return nearest.f >= -0.5 * limit_mm || swept_.refine(here.point, nearest).f >= -limit_mm;
}

Stretch largest_stretch(const Stretch& within, const std::function<bool(double u, double v)>& holds) {
  constexpr int kAlong = 97, kAcross = 49;
  std::vector<char> good(static_cast<std::size_t>(kAlong) * kAcross);
  parallel_for(kAlong, [&](std::size_t i) {
    for (std::size_t j = 0; j < kAcross; ++j)
      good[i * kAcross + j] =
          holds(within.u(static_cast<double>(i) / (kAlong - 1)), within.v(static_cast<double>(j) / (kAcross - 1))) ? 1
                                                                                                                   : 0;
  });
  int best[4] = {0, 0, 0, 0}, most = 0;
  for (int first = 0; first < kAlong; ++first) {
    std::vector<char> all(kAcross, 1);  // good from `first` to `last`
    for (int last = first; last < kAlong; ++last) {
      int run = 0;
      for (int j = 0; j < kAcross; ++j) {
        const auto at = static_cast<std::size_t>(j);
        all[at] = all[at] != 0 && good[static_cast<std::size_t>(last * kAcross + j)] != 0 ? 1 : 0;
        run = all[at] != 0 ? run + 1 : 0;
        if ((run - 1) * (last - first) <= most) continue;
        most = (run - 1) * (last - first);
        best[0] = first, best[1] = last, best[2] = j - run + 1, best[3] = j;
      }
    }
  }
  return {within.u(best[0] / (kAlong - 1.0)), within.u(best[1] / (kAlong - 1.0)), within.v(best[2] / (kAcross - 1.0)),
          within.v(best[3] / (kAcross - 1.0))};
}

}  // namespace flank::internal
