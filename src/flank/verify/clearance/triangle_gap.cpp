// The signed distance to a convex body is a convex function. Its least value on a triangle lies in the triangle's
// interior only if the gradient there is normal to the plane: at the body's support point of that direction, or, where
// the plane cuts the body, wherever; else on a side, where one derivative has one root.
#include "flank/verify/clearance/triangle_gap.h"

#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"

namespace flank::internal::verify {
namespace {

constexpr int kMostSteps = 80;  ///< of a line search: bisection alone takes 50 to the last bit
/// Of the squared longest side: a triangle with less doubled area is a segment, whose plane is round-off.
constexpr double kNoArea = 1e-14;
constexpr double kNoBracket = 1e-15;  ///< a bracket of [0, 1] that cannot be halved any more
constexpr double kGolden = 0.6180339887498949;

/// Value and slopes of the signed distance along x = from + t step.
struct LineJet {
  double value = 0.0, slope = 0.0, bend = 0.0;
};

struct Line {
  Vec3 from, step;

  [[nodiscard]] Vec3 at(double t) const { return from + t * step; }
};

LineJet line_jet(const Revolved& body, const Line& line, double t) {
  const Vec3 x = line.at(t);
  const double rho = x.head<2>().norm();
  const ProfileDistance d = body.distance(x.z(), rho);
  const double across = line.step.x() * line.step.x() + line.step.y() * line.step.y();
  // On the axis itself rho grows in every direction: any slope between the two one-sided ones is a subgradient.
  const double drho = rho > 0.0 ? (x.x() * line.step.x() + x.y() * line.step.y()) / rho : 0.0;
  const double ddrho = rho > 0.0 ? std::max(0.0, across - drho * drho) / rho : 0.0;
  const double turn = d.drho * line.step.z() - d.dz * drho;
  return {d.value, d.dz * line.step.z() + d.drho * drho, d.corner * turn * turn + d.drho * ddrho};
}

Vec3 gradient_at(const Revolved& body, const Vec3& x) {
  const double rho = x.head<2>().norm();
  const ProfileDistance d = body.distance(x.z(), rho);
  if (!(rho > 0.0)) return {d.drho, 0.0, d.dz};
  return {d.drho * x.x() / rho, d.drho * x.y() / rho, d.dz};
}

struct LineMinimum {
  double value = 1e300, t = 0.0;
};

/// Root of the growing slope in [0, 1], by Newton's method inside a bracket. Between the bracket's ends the value can
/// lie below that of the last place by no more than |slope| times the bracket: that is the stopping rule.
LineMinimum line_minimum(const Revolved& body, const Line& line, double error = 0.1 * kTriangleGapErrorMm) {
  const LineJet first = line_jet(body, line, 0.0);
  if (first.slope >= 0.0) return {first.value, 0.0};
  const LineJet last = line_jet(body, line, 1.0);
  if (last.slope <= 0.0) return {last.value, 1.0};
  LineMinimum best = first.value < last.value ? LineMinimum{first.value, 0.0} : LineMinimum{last.value, 1.0};
  double low = 0.0, high = 1.0, slope_low = first.slope, slope_high = last.slope;
  double t = slope_low / (slope_low - slope_high);
  for (int i = 0; i < kMostSteps; ++i) {
    const LineJet at = line_jet(body, line, t);
    if (at.value < best.value) best = {at.value, t};
    const double open = high - low;
    if (at.slope > 0.0) {
      high = t;
      slope_high = at.slope;
    } else {
      low = t;
      slope_low = at.slope;
    }
    if (std::abs(at.slope) * (high - low) <= error || !(high - low > kNoBracket)) break;
    // Newton's step, but every third one bisects unless the bracket was halved: corners have no second derivative to
    // trust.
    const double newton = at.bend > 0.0 ? t - at.slope / at.bend : -1.0;
    const bool shrinks = high - low < 0.5 * open;
    t = newton > low && newton < high && (shrinks || i % 3 != 2) ? newton : 0.5 * (low + high);
  }
  return best;
}

/// Least value over the whole triangle, the plane cutting the body: the least over the lines parallel to one side is a
/// convex function of the line.
TriangleGap deepest(const Revolved& body, const std::array<Vec3, 3>& v, double error) {
  TriangleGap best;
  const auto across = [&](double s) {
    const Line line{v[0] + s * (v[1] - v[0]), s * (v[2] - v[1])};
    const LineMinimum found = line_minimum(body, line, 0.1 * error);
    if (found.value < best.value) best = {found.value, line.at(found.t), Vec3::Zero()};
    return found.value;
  };
  double low = 0.0, high = 1.0, c = 1.0 - kGolden, d = kGolden;
  const double reach = std::max((v[1] - v[0]).norm(), (v[2] - v[0]).norm());
  across(0.0);
  across(1.0);
  double fc = across(c), fd = across(d);
  while ((high - low) * reach > 0.5 * error) {
    if (fc < fd) {
      high = d, d = c, fd = fc, c = high - kGolden * (high - low), fc = across(c);
    } else {
      low = c, c = d, fc = fd, d = low + kGolden * (high - low), fd = across(d);
    }
  }
  best.normal = gradient_at(body, best.point);
  return best;
}

/// Whether a point of the plane lies in the triangle; `cross` is the doubled area vector.
bool holds(const std::array<Vec3, 3>& v, const Vec3& cross, const Vec3& x) {
  for (int k = 0; k < 3; ++k) {
    const Vec3& a = v[static_cast<std::size_t>(k)];
    const Vec3& b = v[static_cast<std::size_t>((k + 1) % 3)];
    if ((b - a).cross(x - a).dot(cross) < 0.0) return false;
  }
  return true;
}

/// The point of the body that is farthest along n.
Vec3 support_point(const Revolved& body, const Vec3& n) {
  const double across = n.head<2>().norm();
  const Vec2& c = body.support(n.z(), across);
  const Vec3 rounded = body.rounding() * n;
  if (!(across > 0.0)) return rounded + Vec3(0.0, 0.0, c.x());
  return rounded + Vec3(c.y() * n.x() / across, c.y() * n.y() / across, c.x());
}

TriangleGap best_side(const Revolved& body, const std::array<Vec3, 3>& v, double cutoff) {
  TriangleGap best;
  best.value = cutoff;
  for (std::size_t k = 0; k < 3; ++k) {
    const Line line{v[k], v[(k + 1) % 3] - v[k]};
    const Vec3 middle = line.at(0.5);
    if (body.value(middle.z(), middle.head<2>().norm()) - 0.5 * line.step.norm() >= best.value) continue;
    const LineMinimum found = line_minimum(body, line);
    if (found.value < best.value) best = {found.value, line.at(found.t), Vec3::Zero()};
  }
  if (best.value < cutoff) best.normal = gradient_at(body, best.point);
  return best;
}

/// The least signed distance on the triangle that the planes of the two sides allow that face x, a point inside of the body, most.
double sides_bound(const Revolved& body, const Vec3& x, const std::array<Vec3, 3>& v) {
  std::array<std::array<double, 3>, 2> out;
  const std::array<Vec3, 2> normals = facing_normals(body, x);
  for (std::size_t i = 0; i < 2; ++i) {
    const double support = normals[i].dot(support_point(body, normals[i]));
    for (std::size_t k = 0; k < 3; ++k) out[i][k] = normals[i].dot(v[k]) - support;
  }
  return least_of_larger(out[0], out[1]);
}

/// The least value on the triangle that the tangent plane of a convex function at x allows.
double tangent_bound(double value, const Vec3& gradient, const Vec3& x, const std::array<Vec3, 3>& v) {
  return value + std::min({gradient.dot(v[0] - x), gradient.dot(v[1] - x), gradient.dot(v[2] - x)});
}

}  // namespace

std::array<Vec3, 2> facing_normals(const Revolved& body, const Vec3& x) {
  const double rho = x.head<2>().norm();
  const Vec2 out = rho > 0.0 ? Vec2(x.head<2>() / rho) : Vec2::UnitX();
  std::array<Vec3, 2> normals;
  const std::array<Vec2, 2> sides = body.facing(x.z(), rho);
  for (std::size_t i = 0; i < 2; ++i) normals[i] = Vec3(sides[i].y() * out.x(), sides[i].y() * out.y(), sides[i].x());
  return normals;
}

// With a share s of a and the rest of b it is the least of three lines in s: the best is at an end, or where two of them meet.
double least_of_larger(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  double best = -1e300;
  const auto try_share = [&](double s) {
    if (!(s >= 0.0 && s <= 1.0)) return;
    double least = 1e300;
    for (std::size_t k = 0; k < 3; ++k) least = std::min(least, s * a[k] + (1.0 - s) * b[k]);
    best = std::max(best, least);
  };
  try_share(0.0);
  try_share(1.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3;
    try_share((b[l] - b[k]) / ((a[k] - b[k]) - (a[l] - b[l])));
  }
  return best;
}

TriangleGap triangle_gap(const Revolved& body, const std::array<Vec3, 3>& v, double cutoff, double depth_error_mm) {
  FLANK_ASSERT(depth_error_mm > 0.0);
  const Vec3 middle = (v[0] + v[1] + v[2]) / 3.0;
  const Vec3 slope = gradient_at(body, middle);
  const double far = tangent_bound(body.value(middle.z(), middle.head<2>().norm()), slope, middle, v);
  if (far >= cutoff) return {far, middle, slope};
  const Vec3 cross = (v[1] - v[0]).cross(v[2] - v[0]);
  const double doubled = cross.norm();
  const double longest = std::max((v[1] - v[0]).squaredNorm(), (v[2] - v[0]).squaredNorm());
  if (!(doubled > kNoArea * longest)) return best_side(body, v, cutoff);
  const Vec3 n = cross / doubled;
  const double offset = n.dot(v[0]);
  const Vec3 above = support_point(body, n), below = support_point(body, -n);
  const double over = offset - n.dot(above), under = n.dot(below) - offset;
  const double apart = std::max(over, under);
  if (apart >= cutoff) return {apart, v[0], n};
  // No point of the plane is lower than `apart`; outside the body the foot of its support point is as low, inside it
  // may be.
  const Vec3 direction = over > under ? n : Vec3(-n);
  const Vec3 foot = (over > under ? above : below) + apart * direction;
  if (holds(v, cross, foot)) {
    const double value = apart > 0.0 ? apart : body.value(foot.z(), foot.head<2>().norm());
    if (value <= apart + depth_error_mm) return {value, foot, direction};
  }
  if (apart > 0.0) return best_side(body, v, cutoff);
  const TriangleGap side = best_side(body, v, cutoff);
  // The plane cuts the body in a convex region: that meets a side, or it lies wholly in the triangle or outside.
  const double share = over / (over + under);
  const Vec3 cut = std::isfinite(share) ? Vec3(above + share * (below - above)) : above;
  if (side.value > 0.0 && !holds(v, cross, cut)) return side;
  // Mostly a side, or a corner, is the deepest place, and its tangent plane proves it.
  if (side.value < cutoff && tangent_bound(side.value, side.normal, side.point, v) >= side.value - depth_error_mm)
    return side;
  if (side.value < std::min(0.0, cutoff) && sides_bound(body, side.point, v) >= side.value - depth_error_mm)
    return side;
  const TriangleGap inside = deepest(body, v, depth_error_mm);
  return inside.value < side.value ? inside : side;
}

}  // namespace flank::internal::verify
