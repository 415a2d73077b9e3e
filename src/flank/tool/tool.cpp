#include "flank/tool.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "flank/base/assert.h"

namespace flank {

Vec2 meridian_point(const RadialFunction& radial, double s) {
  const RadialJet f = radial.at(s);
  // (1 - d)(1 + d) and not 1 - d^2, which loses its digits where |r'| comes near to 1.
  return {s - f.r * f.d1, f.r * std::sqrt((1.0 - f.d1) * (1.0 + f.d1))};
}

std::vector<Vec2> meridian(const RadialFunction& radial, int count) {
  FLANK_ASSERT(count >= 0);
  std::vector<Vec2> points(static_cast<std::size_t>(count));
  const double length = radial.axis_length();
  for (int i = 0; i < count; ++i)
    points[static_cast<std::size_t>(i)] = meridian_point(radial, count > 1 ? length * i / (count - 1) : 0.0);
  return points;
}

namespace {

/// The conditions as functions that must stay positive, each smooth within a knot span.
using Margins = std::array<double, 4>;
constexpr double kRoundOff = 1e-13;
enum Condition { kRadius, kSlopeUp, kSlopeDown, kConvexity };

/// Relative or without unit, so that one number can say how near to illegitimate a tool is. NaN counts as violated.
Margins margins(const RadialFunction& radial, double s) {
  const RadialJet f = radial.at(s);
  Margins m = {f.r / radial.axis_length(), 1.0 - f.d1, 1.0 + f.d1, 1.0 - f.d1 * f.d1 - f.r * f.d2};
  for (double& v : m)
    if (std::isnan(v)) v = -std::numeric_limits<double>::infinity();
  return m;
}

/// Where one margin has its minimum in [a, b], by kGolden section; good to sqrt(machine precision) of the step, its
/// value to machine precision.
double minimise(const RadialFunction& radial, int which, double a, double b) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kSteps = 40;  // 0.618^40 = 4e-9
  double x1 = b - kGolden * (b - a), x2 = a + kGolden * (b - a);
  double f1 = margins(radial, x1)[which], f2 = margins(radial, x2)[which];
  for (int i = 0; i < kSteps; ++i) {
    if (f1 < f2) {
      b = x2, x2 = x1, f2 = f1;
      x1 = b - kGolden * (b - a), f1 = margins(radial, x1)[which];
    } else {
      a = x1, x1 = x2, f1 = f2;
      x2 = a + kGolden * (b - a), f2 = margins(radial, x2)[which];
    }
  }
  return f1 < f2 ? x1 : x2;
}

/// First s in [a, b] with the margin not positive, given that it is positive at a and not at b.
double first_crossing(const RadialFunction& radial, int which, double a, double b) {
  for (int i = 0; i < 60 && b > a; ++i) {
    const double middle = 0.5 * (a + b);
    (margins(radial, middle)[which] > 0.0 ? a : b) = middle;
  }
  return b;
}

/// Where a condition is violated most, by the samples; a place that is known to violate it, if none of them does.
double worst_place(const RadialFunction& radial, int which, double known, int steps) {
  double worst = known, least = margins(radial, known)[which];
  for (int i = 0; i <= steps; ++i) {
    const double s = radial.axis_length() * i / steps, margin = margins(radial, s)[which];
    if (margin < least) least = margin, worst = s;
  }
  return worst;
}

/// The violated condition in words, with the numbers at s and what is needed instead.
std::string reason(const RadialFunction& radial, int which, double s) {
  const RadialJet f = radial.at(s);
  std::array<char, 240> text{};
  const auto print = [&](const char* format, auto... values) {
    std::snprintf(text.data(), text.size(), format, values...);
  };
  if (!std::isfinite(f.r) || !std::isfinite(f.d1) || !std::isfinite(f.d2))
    print("the radius is not a finite number at s = %.6g mm: the parameters fit no tool of this length", s);
  else if (which == kRadius)
    print("r = %.6g mm at s = %.6g mm: the radius must be positive", f.r, s);
  else if (which == kConvexity)
    print(
        "the profile bulges too sharply: 1 - r'^2 - r r'' = %.6g at s = %.6g mm must be > 0 (its radius of curvature "
        "must exceed its distance from the axis)",
        1.0 - f.d1 * f.d1 - f.r * f.d2, s);
  else
    print("the profile is too steep: r' = %.6g at s = %.6g mm (|r'| < 1 is required)", f.d1, s);
  return text.data();
}

/// Equal steps that include every knot of a spline, so that each step is smooth.
int step_count(const RadialFunction& radial) {
  constexpr int kSmallest = 512;
  if (radial.family() != ToolFamily::kSpline) return kSmallest;
  const int spans = radial.parameter_count() - 3;
  return spans * std::max(16, (kSmallest + spans - 1) / spans);
}

/// Where a condition is nearest to being violated, or is.
struct Place {
  double s = 0.0, margin = std::numeric_limits<double>::infinity();
  int which = kRadius;
};

}  // namespace

Legitimacy check_legitimacy(const RadialFunction& radial) {
  const int steps = step_count(radial);
  const double length = radial.axis_length();
  Place least, violation;
  // Also keeps the first violation along the axis, found back to where the margin was still positive.
  const auto visit = [&](double s, double positive_before, int which) {
    const double margin = margins(radial, s)[which];
    if (margin < least.margin) least = {s, margin, which};
    if (margin > 0.0) return;
    const double at = positive_before < s ? first_crossing(radial, which, positive_before, s) : s;
    if (violation.margin > 0.0 || at < violation.s) violation = {at, margin, which};
  };
  const auto sample = [&](int i) { return length * i / steps; };
  Margins before{}, here = margins(radial, 0.0), after{};
  for (int i = 0; i <= steps && violation.margin > 0.0; ++i, before = here, here = after) {
    after = i < steps ? margins(radial, sample(i + 1)) : here;
    for (int k = 0; k < static_cast<int>(here.size()); ++k) {
      const double left = sample(std::max(i - 1, 0)), right = sample(std::min(i + 1, steps));
      visit(sample(i), left, k);
      const bool inner = i > 0 && i < steps;
      const bool dip = (i == 0 || here[k] <= before[k]) && (i == steps || here[k] <= after[k]);
      // A dip is at most an eighth of the second difference deeper than its lowest sample: none on a plateau.
      const bool flat = inner && before[k] + after[k] - 2.0 * here[k] <= kRoundOff * (1.0 + std::abs(here[k]));
      if (!dip || flat || here[k] <= 0.0) continue;
      if (i > 0) visit(minimise(radial, k, left, sample(i)), left, k);
      if (i < steps) visit(minimise(radial, k, sample(i), right), sample(i), k);
    }
  }
  if (violation.margin > 0.0) return {true, least.s, least.margin, ""};
  const double worst = worst_place(radial, violation.which, violation.s, steps);
  return {false, violation.s, least.margin, reason(radial, violation.which, worst)};
}

}  // namespace flank
