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
RadialJet power_jet(double, const double* p, double s) {
  const double base = p[0] + p[1] * s, e = 1.0 / p[3];
  if (!(base > 0.0)) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan, nan};
  }
  const double r = std::pow(base, e) / p[2];
  const double d1 = r * e * p[1] / base;
  return {r, d1, d1 * (e - 1.0) * p[1] / base};
}

void power_gradient(double length, const double* p, double s, double* out) {
  const double base = p[0] + p[1] * s, e = 1.0 / p[3];
  const double r = power_jet(length, p, s).r;
  out[0] = r * e / base;
  out[1] = out[0] * s;
  out[2] = -r / p[2];
  out[3] = -r * std::log(base) * e * e;
}

/// k = 1 / (p0 - p1), so dk/dp0 = -k^2 and dk/dp1 = k^2; the largest radius acts on r directly, too.
void barrel_gradient(double, const double* p, double s, double* out) {
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

RadialJet cylinder_jet(double, const double* p, double) { return {p[0], 0.0, 0.0}; }
void cylinder_gradient(double, const double*, double, double* out) { out[0] = 1.0; }

RadialJet cone_jet(double, const double* p, double s) {
  const double slope = std::sin(p[1]);
  return {p[0] + slope * s, slope, 0.0};
}
void cone_gradient(double, const double* p, double s, double* out) {
  out[0] = 1.0;
  out[1] = s * std::cos(p[1]);
}

RadialJet hyperbolic_jet(double length, const double* p, double s) {
  const double x = s - 0.5 * length;
  return {p[0] + x * (p[1] + p[2] * x), p[1] + 2.0 * p[2] * x, 2.0 * p[2]};
}
void hyperbolic_gradient(double length, const double*, double s, double* out) {
  const double x = s - 0.5 * length;
  out[0] = 1.0;
  out[1] = x;
  out[2] = x * x;
}
double hyperbolic_turn(double length, const double* p) {
  return p[2] != 0.0 ? 0.5 * length - 0.5 * p[1] / p[2] : std::numeric_limits<double>::quiet_NaN();
}

using Typical = std::array<double, 4>;

}  // namespace

constexpr std::array<Family, kToolFamilies.size()> kFamilies{{
    {.name = "cylinder",
     .parameters = {"radius"},
     .count = 1,
     .jet = cylinder_jet,
     .gradient = cylinder_gradient,
     .typical = [](double, double radius) { return Typical{radius}; }},
    {.name = "cone",
     .parameters = {"radius", "angle"},
     .count = 2,
     .angle = 1,
     .angle_high = kMostConeAngle,
     .jet = cone_jet,
     .gradient = cone_gradient,
     .typical =
         [](double, double radius) {
           return Typical{radius, 0.01};
         }},
    {.name = "barrel",
     .parameters = {"arc", "radius", "s0"},
     .count = 3,
     .middle = 2,
     .jet = [](double, const double* p, double s) { return barrel_arc(p, s).jet(p[1]); },
     .gradient = barrel_gradient,
     .turning_point = [](double, const double* p) { return p[2]; },
     .typical =
         [](double length, double radius) {
           return Typical{radius + 4.0 * length, radius, 0.5 * length};
         }},
    {.name = "lens",
     .parameters = {"radius", "end_radius"},
     .count = 2,
     .jet = [](double length, const double* p, double s) { return lens_arc(length, p, s).jet(p[0]); },
     .gradient = lens_gradient,
     .turning_point = [](double length, const double*) { return 0.5 * length; },
     .typical =
         [](double, double radius) {
           return Typical{radius, 0.95 * radius};
         }},
    {.name = "tapered-barrel",
     .parameters = {"arc", "radius", "angle"},
     .count = 3,
     .angle = 2,
     .angle_high = kMostTaperAngle,
     .jet = [](double length, const double* p, double s) { return tapered_arc(length, p, s).jet(p[1]); },
     .gradient = tapered_gradient,
     // sigma - k x = 0
     .turning_point = [](double length, const double* p) { return 0.5 * length + std::sin(p[2]) * (p[0] - p[1]); },
     .typical =
         [](double length, double radius) {
           return Typical{radius + 4.0 * length, radius, 0.02};
         }},
    {.name = "hyperbolic",
     .parameters = {"radius", "slope", "bend"},
     .count = 3,
     .angle_low = -kMostSlope,
     .angle_high = kMostSlope,
     .jet = hyperbolic_jet,
     .gradient = hyperbolic_gradient,
     .turning_point = hyperbolic_turn,
     .typical =
         [](double length, double radius) {
           return Typical{radius, 0.0, 0.02 / length};
         }},
    {.name = "power",
     .parameters = {"a", "b", "c", "d"},
     .count = 4,
     .jet = power_jet,
     .gradient = power_gradient,
     .typical =
         [](double, double radius) {
           return Typical{radius * radius, 0.01 * radius, 1.0, 2.0};
         }},
    {.name = "spline"},
}};

}  // namespace flank::internal
