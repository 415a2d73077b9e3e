#include "flank/tool/meridian.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "flank/base/assert.h"
#include "flank/error.h"

namespace flank::internal {

namespace {

constexpr double kCoverShare = 0.01;  ///< how much of the axis length the profile may leave uncovered at either end
constexpr int kSteps = 12;
constexpr int kFootpointSteps = 30;

std::string at_point(std::size_t i) { return "meridian profile, point " + std::to_string(i + 1) + ": "; }

/// Direction (dz, drho) of the curve at point i, from the parabola through it and its neighbours over the chord length.
Vec2 tangent(std::span<const Vec2> profile, std::size_t i) {
  const std::size_t m = std::clamp<std::size_t>(i, 1, profile.size() - 2);
  const Vec2 a = profile[m] - profile[m - 1], b = profile[m + 1] - profile[m];
  const double la = a.norm(), lb = b.norm();
  const Vec2 slope_a = a / la, slope_b = b / lb, bend = (slope_b - slope_a) / (la + lb);
  if (i < m) return slope_a - la * bend;
  if (i > m) return slope_b + lb * bend;
  return slope_a + la * bend;
}

/// Samples (s, r) of the normals; refuses what no inscribed spheres can have.
std::vector<Vec2> spheres(std::span<const Vec2> profile) {
  if (profile.size() < 4) throw InputError("meridian profile: expected at least 4 points (z, radius)");
  std::vector<Vec2> samples(profile.size());
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (!profile[i].allFinite()) throw InputError(at_point(i) + "coordinates must be finite numbers");
    if (!(profile[i].y() > 0.0)) throw InputError(at_point(i) + "the radius must be > 0");
    if (i > 0 && !(profile[i].x() > profile[i - 1].x()))
      throw InputError(at_point(i) + "z must increase from the tip towards the holder");
  }
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const Vec2 t = tangent(profile, i);
    if (!(t.x() > 0.0))
      throw InputError(at_point(i) + "the profile is perpendicular to the axis here; z must increase");
    const double slope = t.y() / t.x();
    samples[i] = {profile[i].x() + profile[i].y() * slope, profile[i].y() * std::hypot(1.0, slope)};
    if (i > 0 && !(samples[i].x() > samples[i - 1].x()))
      throw InputError(at_point(i) +
                       "the profile bulges too sharply here, or is not smooth: its radius of curvature must exceed its "
                       "distance from the axis");
  }
  return samples;
}

/// The s where the distance of (z, rho) to the sphere of s is smallest, by safeguarded Newton from `s`.
double touching_sphere(const RadialFunction& radial, const Vec2& p, double s) {
  for (int step = 0; step < kFootpointSteps; ++step) {
    const RadialJet f = radial.at(s);
    const double d = std::hypot(s - p.x(), p.y());
    const double slope = (s - p.x()) / d - f.d1, bend = p.y() * p.y() / (d * d * d) - f.d2;
    const double move = bend > 0.0 ? slope / bend : slope * d;
    s -= std::clamp(move, -0.5 * d, 0.5 * d);
    if (std::abs(move) <= 1e-14 * radial.axis_length()) break;
  }
  return s;
}

/// Gauss-Newton on the distances of the profile's points to the union of the spheres.
RadialFunction polish(RadialFunction radial, std::span<const Vec2> profile, std::vector<Vec2> samples) {
  const int n = radial.parameter_count();
  std::vector<Vec2> fitted(samples.size());
  for (int step = 0; step < kSteps; ++step) {
    double largest = 0.0;
    for (std::size_t i = 0; i < profile.size(); ++i) {
      const Vec2& p = profile[i];
      samples[i].x() = touching_sphere(radial, p, samples[i].x());
      // Linearised at the touching sphere, the condition is linear in r: r(s) = |p - (s, 0)|.
      fitted[i] = {samples[i].x(), std::hypot(p.x() - samples[i].x(), p.y())};
      largest = std::max(largest, std::abs(fitted[i].y() - radial.at(fitted[i].x()).r));
    }
    const RadialFunction next = RadialFunction::spline_through(radial.axis_length(), fitted, n);
    const double change = (next.parameters() - radial.parameters()).cwiseAbs().maxCoeff();
    radial = next;
    if (!(change > 1e-14 * radial.axis_length()) || !(largest > 0.0)) break;
  }
  return radial;
}

}  // namespace

RadialFunction radial_from_meridian(std::span<const Vec2> profile, std::optional<double> axis_length,
                                    int coefficients) {
  FLANK_ASSERT(coefficients >= 4);
  const std::vector<Vec2> all = spheres(profile);
  const double shift = axis_length ? 0.0 : all.front().x();
  const double length = axis_length.value_or(all.back().x() - all.front().x());
  if (!(length > 0.0 && std::isfinite(length))) throw InputError("meridian profile: the axis length must be > 0");
  const double slack = kCoverShare * length;
  if (all.front().x() - shift > slack || all.back().x() - shift < length - slack)
    throw InputError("meridian profile: it gives radii from s = " + std::to_string(all.front().x()) + " to " +
                     std::to_string(all.back().x()) + " mm only, not over the axis length of " +
                     std::to_string(length) + " mm");
  std::vector<Vec2> points, samples;  // of the profile that belongs to [0, L], both from s = 0
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Vec2 sample = all[i] - Vec2(shift, 0.0);
    if (sample.x() < -slack || sample.x() > length + slack) continue;
    samples.push_back(sample);
    points.emplace_back(profile[i].x() - shift, profile[i].y());
  }
  return polish(RadialFunction::spline_through(length, samples, coefficients), points, samples);
}

}  // namespace flank::internal
