#include "flank/envelope/contact_refiner.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flank/base/assert.h"
#include "flank/bspline_basis.h"

namespace flank::internal {
namespace {

/// Against a division by zero for a point on the axis.
constexpr double kTiny = 1e-300;

/// The span of n even ones on [0, 1] that holds x, and where in it, 0 to 1.
struct EvenPlace {
  std::size_t span;
  double within;
};

EvenPlace even_place(double x, std::size_t n) {
  const double at = x * static_cast<double>(n);
  // Not a number is in the first, and stays what it is: a fit may pass through states without a value.
  const double k = at > 0.0 ? std::min(std::floor(at), static_cast<double>(n) - 1.0) : 0.0;
  return {static_cast<std::size_t>(k), at - k};
}

/// Whether a curve is a cubic with even knots over [0, 1].
bool is_even_cubic(const BSplineCurve3& curve) {
  constexpr double kRounding = 1e-14;
  if (curve.degree != 3 || !curve.weights.empty()) return false;
  const std::vector<double> even = uniform_knots(3, curve.count());
  return std::equal(even.begin(), even.end(), curve.knots.begin(), curve.knots.end(),
                    [](double a, double b) { return std::abs(a - b) <= kRounding; });
}

/// The powers of a curve's cubic in its span k of n.
std::array<Vec3, 4> powers(const BSplineCurve3& curve, std::size_t k, std::size_t n) {
  std::array<double, 16> basis;
  const int span = static_cast<int>(k) + 3;
  basis_derivatives(3, curve.knots, span, curve.knots[k + 3], 3, basis.data());
  std::array<Vec3, 4> c;
  double scale = 1.0;  // of the power m: the width of the span, to the m, over m!
  for (std::size_t m = 0; m < 4; ++m) {
    if (m > 0) scale /= static_cast<double>(n * m);
    c[m] = Vec3::Zero();
    for (int j = 0; j < 4; ++j)
      c[m] += scale * basis[4 * m + static_cast<std::size_t>(j)] * curve.poles.col(span - 3 + j);
  }
  return c;
}

template <class Value>
Value value_of(const std::array<Value, 4>& c, double x) {
  return c[0] + x * (c[1] + x * (c[2] + x * c[3]));
}

/// Value and two derivatives, by the variable of which a span is 1 / n.
template <class Value>
std::array<Value, 3> jet_of(const std::array<Value, 4>& c, double x, double n) {
  return {value_of(c, x), n * (c[1] + x * (2.0 * c[2] + 3.0 * x * c[3])), n * n * (2.0 * c[2] + 6.0 * x * c[3])};
}

}  // namespace

ContactRefiner::ContactRefiner(const std::vector<RuledMotion>& motions, const RadialFunction& radial)
    : radial_(radial), length_(radial.axis_length()), low_(radial.at(0.0).r), high_(radial.at(length_).r) {
  for (const RuledMotion& motion : motions) rails_.push_back(rails_of(motion));
  if (radial.family() != ToolFamily::kSpline) return;
  const int spans = radial.parameter_count() - 3;
  const double width = length_ / spans;
  for (int k = 0; k < spans; ++k) {
    // The second derivative of a cubic is straight.
    const RadialJet from = radial.at(k * width), to = radial.at((k + 1) * width);
    profile_.push_back(
        {{from.r, from.d1 * width, 0.5 * from.d2 * width * width, (to.d2 - from.d2) * width * width / 6.0}});
  }
}

ContactRefiner::Rails ContactRefiner::rails_of(const RuledMotion& motion) {
  Rails rails;
  if (!is_even_cubic(motion.tip) || !is_even_cubic(motion.direction) ||
      motion.tip.count() != motion.direction.count()) {
    rails.other = motion;
    return rails;
  }
  const auto n = static_cast<std::size_t>(motion.tip.count() - 3);
  for (std::size_t k = 0; k < n; ++k) {
    rails.tip.push_back({powers(motion.tip, k, n)});
    rails.direction.push_back({powers(motion.direction, k, n)});
  }
  return rails;
}

Pose ContactRefiner::pose(const Rails& rails, double t) const {
  if (rails.other) return rails.other->pose(t);
  const auto [k, x] = even_place(t, rails.tip.size());
  return {value_of(rails.tip[k].c, x), value_of(rails.direction[k].c, x).normalized()};
}

ContactRefiner::AxisJet2 ContactRefiner::axis(const Rails& rails, double t) const {
  AxisJet2 jet;
  std::array<Vec3, 3> w;
  if (rails.other) {
    const CurveJet<3> a = rails.other->tip.jet(t), b = rails.other->direction.jet(t);
    jet.tip = {a.p, a.d1, a.d2};
    w = {b.p, b.d1, b.d2};
  } else {
    const auto n = static_cast<double>(rails.tip.size());
    const auto [k, x] = even_place(t, rails.tip.size());
    jet.tip = jet_of(rails.tip[k].c, x, n);
    w = jet_of(rails.direction[k].c, x, n);
  }
  const double length = w[0].norm();
  const Vec3 u = w[0] / length, e = w[1] / length, g = w[2] / length;
  const double grows = u.dot(e);  // |w|' / |w|
  jet.u[0] = u;
  jet.u[1] = e - grows * u;
  jet.u[2] = g - u.dot(g) * u - 2.0 * grows * jet.u[1] - jet.u[1].squaredNorm() * u;
  return jet;
}

RadialJet ContactRefiner::radius(double s) const {
  if (profile_.empty()) return radial_.at(s);
  const auto n = static_cast<double>(profile_.size());
  const auto [k, x] = even_place(s / length_, profile_.size());
  const std::array<double, 3> jet = jet_of(profile_[k].c, x, n / length_);
  return {jet[0], jet[1], jet[2]};
}

/// An end of the axis whose sphere is nearer to a point, at z along the axis and rho from it, than this one; else this one.
ContactRefiner::Sphere ContactRefiner::nearer_end(double z, double rho2, const Sphere& sphere) const {
  const auto f_of = [&](const Sphere& at) { return std::sqrt(rho2 + (z - at.s) * (z - at.s)) - at.r; };
  Sphere best = sphere;
  double least = f_of(best);
  for (const Sphere& end : {Sphere{0.0, low_}, Sphere{length_, high_}})
    if (const double f = f_of(end); f < least) best = end, least = f;
  return best;
}

/// The sphere near s that is stationary for a point at z along the axis and rho from it.
ContactRefiner::Sphere ContactRefiner::stationary(double z, double rho2, double s) const {
  constexpr int kSteps = 5;  // Newton's method squares the error: from 1e-2 of the length to round-off in four
  // Flatter than this the Newton step is not trusted (the slope is -1 on a cylinder, 0 where two spheres are equally
  // near), and the fixed-point step is taken.
  constexpr double kSteepEnough = -0.05;
  constexpr double kSettled = 1e-10;  // of the axis length
  for (int k = 0; k < kSteps; ++k) {
    const RadialJet jet = radius(s);
    const double d = std::sqrt(rho2 + (z - s) * (z - s)) + kTiny;
    // d/ds (D - r) = (s - z) / D - r' = 0, by Newton's method on (z - s) + r' D.
    const double value = (z - s) + jet.d1 * d, slope = -1.0 + jet.d2 * d - jet.d1 * (z - s) / d;
    const double next = std::clamp(slope < kSteepEnough ? s - value / slope : s + value, 0.0, length_);
    const double moved = next - s;
    s = next;
    // So near to the last place its tangent gives the radius to round-off.
    if (std::abs(moved) < kSettled * length_) return {s, jet.r + jet.d1 * moved};
  }
  return {s, radius(s).r};
}

/// Nearest sphere of the tool at one pose: the stationary s, or an end.
SweptContact ContactRefiner::at(const Rails& rails, const Vec3& x, double t, double s) const {
  const Pose pose = this->pose(rails, t);
  const Vec3 q = x - pose.tip;
  const double z = q.dot(pose.axis), rho2 = std::max(0.0, q.squaredNorm() - z * z);
  SweptContact contact;
  contact.t = t;
  if (!std::isfinite(rho2 + z)) {
    // The direction rail vanishes here, or the rails have no values: nothing is near to that.
    contact.f = std::numeric_limits<double>::infinity();
    return contact;
  }
  const Sphere sphere = nearer_end(z, rho2, stationary(z, rho2, s));
  const Vec3 away = pose.at(sphere.s) - x;
  constexpr double kOnAxisMm = 1e-12;  // a point on the axis has no direction to it: the default stays
  const double d = away.norm();
  contact.s = sphere.s;
  contact.f = d - sphere.r;
  if (d > kOnAxisMm) contact.to_axis = away / d;
  return contact;
}

namespace {

/// f(t, s) = |R(s, t) - x| - r(s) at a place, to second order.
struct Quadratic {
  double t, s, tt, ts, ss;  ///< derivatives
};

/// A step to where a quadratic is least, with what a bound holds back left where it is; nothing where it has no least place.
struct Step {
  double t = 0.0, s = 0.0;
};

std::optional<Step> least_of(const Quadratic& q, bool t_held, bool s_held) {
  constexpr double kDefinite = 1e-6;  // of the product of the diagonal: below it the step runs along a valley
  if (t_held && s_held) return Step{};
  if (t_held) return q.ss > 0.0 ? std::optional(Step{0.0, -q.s / q.ss}) : std::nullopt;
  if (s_held) return q.tt > 0.0 ? std::optional(Step{-q.t / q.tt, 0.0}) : std::nullopt;
  const double determinant = q.tt * q.ss - q.ts * q.ts;
  if (!(q.tt > 0.0 && q.ss > 0.0 && determinant > kDefinite * q.tt * q.ss)) return std::nullopt;
  return Step{(q.ts * q.s - q.ss * q.t) / determinant, (q.ts * q.t - q.tt * q.s) / determinant};
}

}  // namespace

/// Newton's method in t and s together. Nothing where it leaves the window, f is not convex, or comes to a place that is no better: on a
/// kink, where another sphere takes over, or far off.
std::optional<SweptContact> ContactRefiner::by_newton(const Rails& rails, const Vec3& x, const SweptContact& first,
                                                      double window) const {
  constexpr int kSteps = 6;
  // A step shorter than these is the last: what it leaves is its square, and s is settled once more.
  constexpr double kLast = 2e-3, kLastAlong = 1e-2;  // of the window; of the axis
  constexpr double kSame = 1e-6;                     // of the axis: the sphere that it came to
  double t = first.t, s = first.s;
  for (int k = 0; k < kSteps; ++k) {
    const AxisJet2 a = axis(rails, t);
    const RadialJet r = radius(s);
    const Vec3 away = a.tip[0] + s * a.u[0] - x, along = a.tip[1] + s * a.u[1], bend = a.tip[2] + s * a.u[2];
    const double d = away.norm() + kTiny;
    const Vec3 w = away / d;
    const double wt = w.dot(along), wu = w.dot(a.u[0]);
    const Quadratic q{wt, wu - r.d1, (along.squaredNorm() - wt * wt) / d + w.dot(bend),
                      (along.dot(a.u[0]) - wt * wu) / d + w.dot(a.u[1]), (1.0 - wu * wu) / d - r.d2};
    const bool t_held = (t <= 0.0 && q.t > 0.0) || (t >= 1.0 && q.t < 0.0);
    const bool s_held = (s <= 0.0 && q.s > 0.0) || (s >= length_ && q.s < 0.0);
    const std::optional<Step> step = least_of(q, t_held, s_held);
    if (!step) return std::nullopt;
    const double next_t = std::clamp(t + step->t, 0.0, 1.0), next_s = std::clamp(s + step->s, 0.0, length_);
    const bool last = std::abs(next_t - t) <= kLast * window && std::abs(next_s - s) <= kLastAlong * length_;
    t = next_t;
    s = next_s;
    if (!(std::abs(t - first.t) <= window)) return std::nullopt;
    if (!last) continue;
    SweptContact found = at(rails, x, t, s);
    if (!(found.f <= first.f) || std::abs(found.s - s) > std::max(kSame * length_, std::abs(step->s)))
      return std::nullopt;
    return found;
  }
  return std::nullopt;
}

/// Parabolas through three points, sixteen times narrower once the least of them is not at an end: the vertex is off
/// by h^2, so the next one has to look h / 16 around it, and two rounds are enough (kNarrow).
SweptContact ContactRefiner::by_brackets(const Rails& rails, const Vec3& x, const SweptContact& first,
                                         double window) const {
  constexpr double kFirst = 0.5, kNarrow = 1e-2, kNarrower = 16.0;  // of the window; of the last step
  constexpr int kRounds = 10;  // a minimum that runs out of the window is followed by steps of h, this many at most
  SweptContact best = first;
  double h = kFirst * window;
  for (int k = 0; k < kRounds && h > kNarrow * window; ++k) {
    const double middle = std::clamp(best.t, h, 1.0 - h);
    const SweptContact a = at(rails, x, middle - h, best.s), b = at(rails, x, middle + h, best.s);
    const SweptContact m = middle == best.t ? best : at(rails, x, middle, best.s);
    const double bend = a.f + b.f - 2.0 * m.f;
    const bool bracketed = m.f <= a.f && m.f <= b.f;
    for (const SweptContact* c : {&a, &m, &b})
      if (c->f < best.f) best = *c;
    const bool at_rim = best.t <= 0.0 || best.t >= 1.0;
    if (bracketed && bend > 0.0) {
      const double vertex = middle + 0.5 * (a.f - b.f) / bend * h;
      const SweptContact v = at(rails, x, vertex, best.s);
      if (v.f < best.f) best = v;
    }
    if (bracketed || at_rim) h /= kNarrower;
  }
  return best;
}

SweptContact ContactRefiner::refine(const Vec3& x, const SweptContact& place, double window) const {
  FLANK_ASSERT(window > 0.0 && x.allFinite() && place.motion >= 0);
  const Rails& rails = rails_[static_cast<std::size_t>(place.motion)];
  const double t = std::clamp(place.t, 0.0, 1.0);
  const Pose near = pose(rails, t);
  const SweptContact first = at(rails, x, t, std::clamp((x - near.tip).dot(near.axis), 0.0, length_));
  const std::optional<SweptContact> smooth = std::isfinite(first.f) ? by_newton(rails, x, first, window) : std::nullopt;
  SweptContact found = smooth ? *smooth : by_brackets(rails, x, first, window);
  found.motion = place.motion;
  return found;
}

}  // namespace flank::internal
