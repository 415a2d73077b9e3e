#include "flank/tool/families.h"

#include <cmath>
#include <limits>

namespace flank::internal {

namespace {

/// Every circular meridian arc is one function of four numbers: x (distance along the axis from a reference point), the
/// sphere's radius there, the curvature k = 1 / (arc - radius) and the slope sine sigma = r'(0):
///   r = radius + (1 - W) / k = radius + (2 sigma x - k x^2) / (1 + W),   W = sqrt(1 - 2 k sigma x + k^2 x^2).
/// The second form has no pole at k = 0, where the arc becomes a straight line (a cone).
struct Arc {
  double x, k, sigma;
  [[nodiscard]] double w() const { return std::sqrt(1.0 + k * x * (k * x - 2.0 * sigma)); }

  [[nodiscard]] RadialJet jet(double radius) const {
    const double root = w();
    const double numerator = sigma - k * x;
    return {radius + x * (2.0 * sigma - k * x) / (1.0 + root), numerator / root,
            -k * (1.0 - sigma * sigma) / (root * root * root)};
  }
  /// dr/dk with x, radius and sigma held.
  [[nodiscard]] double by_k() const {
    const double root = w(), sum = 1.0 + root;
    const double root_by_k = x * (k * x - sigma) / root;
    return -(x * x * sum + x * (2.0 * sigma - k * x) * root_by_k) / (sum * sum);
  }
  /// dr/dsigma with the rest held.
  [[nodiscard]] double by_sigma() const { return x / w(); }
};

/// Parameters: arc radius, largest radius, place of the largest radius along the axis.
Arc barrel_arc(const double* p, double s) { return {s - p[2], 1.0 / (p[0] - p[1]), 0.0}; }

/// Parameters: arc radius, radius at the middle of the axis, angle there.
Arc tapered_arc(double length, const double* p, double s) {
  return {s - 0.5 * length, 1.0 / (p[0] - p[1]), std::sin(p[2])};
}

/// With the drop h = radius - end_radius over the half length l: arc - radius = (l^2 - h^2) / (2 h).
Arc lens_arc(double length, const double* p, double s) {
  const double half = 0.5 * length, drop = p[0] - p[1];
  const double room = half * half - drop * drop;
  // A drop of half the length or more leaves no arc: NaN, which check_legitimacy refuses.
  if (!(room > 0.0)) return {s - half, std::numeric_limits<double>::quiet_NaN(), 0.0};
  return {s - half, 2.0 * drop / room, 0.0};
}

/// dk/dh of the above.
double lens_curvature_by_drop(double length, const double* p) {
  const double half = 0.5 * length, drop = p[0] - p[1];
  const double room = half * half - drop * drop;
  return 2.0 * (half * half + drop * drop) / (room * room);
}

/// r = (p0 + p1 s)^(1 / p3) / p2; NaN if the base is not positive.
RadialJet power_jet(const double* p, double s) {
  const double base = p[0] + p[1] * s, e = 1.0 / p[3];
  if (!(base > 0.0)) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan, nan};
  }
  const double r = std::pow(base, e) / p[2];
  const double d1 = r * e * p[1] / base;
  return {r, d1, d1 * (e - 1.0) * p[1] / base};
}

void power_gradient(const double* p, double s, double* out) {
  const double base = p[0] + p[1] * s, e = 1.0 / p[3];
  const double r = power_jet(p, s).r;
  out[0] = r * e / base;
  out[1] = out[0] * s;
  out[2] = -r / p[2];
  out[3] = -r * std::log(base) * e * e;
}

/// k = 1 / (p0 - p1), so dk/dp0 = -k^2 and dk/dp1 = k^2; the largest radius acts on r directly, too.
void barrel_gradient(const double* p, double s, double* out) {
  const Arc arc = barrel_arc(p, s);
  const double by_k = arc.by_k() * arc.k * arc.k;
  out[0] = -by_k;
  out[1] = 1.0 + by_k;
  out[2] = -arc.jet(p[1]).d1;
}

/// As barrel_gradient; sigma = sin(angle).
void tapered_gradient(double length, const double* p, double s, double* out) {
  const Arc arc = tapered_arc(length, p, s);
  const double by_k = arc.by_k() * arc.k * arc.k;
  out[0] = -by_k;
  out[1] = 1.0 + by_k;
  out[2] = arc.by_sigma() * std::cos(p[2]);
}

/// k depends on the drop alone, which the radius raises and the end radius lowers; the radius acts on r as well.
void lens_gradient(double length, const double* p, double s, double* out) {
  const double by_drop = lens_arc(length, p, s).by_k() * lens_curvature_by_drop(length, p);
  out[0] = 1.0 + by_drop;
  out[1] = -by_drop;
}

}  // namespace

RadialJet family_jet(ToolFamily family, double axis_length, const double* p, double s) {
  switch (family) {
    case ToolFamily::kCylinder:
      return {p[0], 0.0, 0.0};
    case ToolFamily::kCone: {
      const double slope = std::sin(p[1]);
      return {p[0] + slope * s, slope, 0.0};
    }
    case ToolFamily::kBarrel:
      return barrel_arc(p, s).jet(p[1]);
    case ToolFamily::kLens:
      return lens_arc(axis_length, p, s).jet(p[0]);
    case ToolFamily::kTaperedBarrel:
      return tapered_arc(axis_length, p, s).jet(p[1]);
    case ToolFamily::kHyperbolic: {
      const double x = s - 0.5 * axis_length;
      return {p[0] + x * (p[1] + p[2] * x), p[1] + 2.0 * p[2] * x, 2.0 * p[2]};
    }
    case ToolFamily::kPower:
      return power_jet(p, s);
    case ToolFamily::kSpline:
      break;
  }
  return {};
}

void family_gradient(ToolFamily family, double axis_length, const double* p, double s, double* out) {
  switch (family) {
    case ToolFamily::kCylinder:
      out[0] = 1.0;
      return;
    case ToolFamily::kCone:
      out[0] = 1.0;
      out[1] = s * std::cos(p[1]);
      return;
    case ToolFamily::kBarrel:
      return barrel_gradient(p, s, out);
    case ToolFamily::kLens:
      return lens_gradient(axis_length, p, s, out);
    case ToolFamily::kTaperedBarrel:
      return tapered_gradient(axis_length, p, s, out);
    case ToolFamily::kHyperbolic: {
      const double x = s - 0.5 * axis_length;
      out[0] = 1.0;
      out[1] = x;
      out[2] = x * x;
      return;
    }
    case ToolFamily::kPower:
      return power_gradient(p, s, out);
    case ToolFamily::kSpline:
      return;
  }
}

double family_turning_point(ToolFamily family, double axis_length, const double* p) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const double middle = 0.5 * axis_length;
  switch (family) {
    case ToolFamily::kBarrel:
      return p[2];
    case ToolFamily::kLens:
      return middle;
    case ToolFamily::kTaperedBarrel:  // sigma - k x = 0
      return middle + std::sin(p[2]) * (p[0] - p[1]);
    case ToolFamily::kHyperbolic:
      return p[2] != 0.0 ? middle - 0.5 * p[1] / p[2] : kNone;
    case ToolFamily::kCylinder:
    case ToolFamily::kCone:
    case ToolFamily::kPower:
    case ToolFamily::kSpline:
      break;
  }
  return kNone;
}

}  // namespace flank::internal
