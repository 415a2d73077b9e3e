#include "flank/example/example_blades.h"

#include <cmath>

#include "flank/example/example_formula.h"

namespace flank::internal {
namespace {

constexpr double kDegreesToRad = 3.14159265358979323846 / 180.0;

/// The linear pieces between two curves that share their knots: rows v = 0 and v = 1 of a surface, as a surface of
/// degree 3 x 1.
BSplineSurface ruled_between_rows(const BSplineSurface& rows) {
  BSplineSurface ruled = rows;
  ruled.degree_v = 1;
  ruled.knots_v = {0.0, 0.0, 1.0, 1.0};
  ruled.count_v = 2;
  ruled.poles.clear();
  for (int i = 0; i < rows.count_u; ++i) {
    ruled.poles.push_back(rows.pole(i, 0));
    ruled.poles.push_back(rows.pole(i, rows.count_v - 1));
  }
  return ruled;
}

Vec3 ruled_blade_point(double u, double v) {
  // On a helicoid (x, rho sin(p x), rho cos(p x)) the normal at rho is turned by atan(p rho): +-25 degrees at the
  // edges.
  constexpr double kTravel = 70.0, kHalfRuling = 25.0;
  const double pitch = std::tan(25.0 * kDegreesToRad) / kHalfRuling;
  const double x = kTravel * (u - 0.5);
  const double bend = 4.0 * (1.0 - 4.0 * (u - 0.5) * (u - 0.5));  // mm, of the spine
  const double rho = kHalfRuling * (2.0 * v - 1.0), angle = pitch * x;
  return {x, bend - rho * std::sin(angle), rho * std::cos(angle)};
}

Vec3 twisted_blade_point(double u, double v) {
  constexpr double kHeight = 60.0, kRootStagger = 25.0 * kDegreesToRad;
  const double chord = 46.0 - 6.0 * v;
  const double camber = (0.08 - 0.03 * v) * chord;
  // A parabola of camber with a little more of it in front, as blades have it.
  const double along =
      1.0 - u;  // from the leading edge; u runs against it so that the normal looks out of the convex side
  const double x = chord * (along - 0.5);
  const double y = 4.0 * camber * along * (1.0 - along) * (1.0 + 0.25 * (0.5 - along));
  const double angle = kRootStagger + kTwistedBladeTwistRad * v;
  const double bow = 1.5 * 4.0 * v * (1.0 - v);  // mm, across the chord
  return {std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y + bow, kHeight * v};
}

Vec3 elliptic_side_point(double u, double v) {
  constexpr double kHeight = 45.0, kRadius = 45.0, kTaper = 0.1, kLongRadius = 20000.0;
  const double z = kHeight * (v - 0.5);
  const double radius = kRadius + kTaper * (z + 0.5 * kHeight) - z * z / (2.0 * kLongRadius);
  const double angle = 60.0 * kDegreesToRad * (0.5 - u);
  return {radius * std::sin(angle), radius * std::cos(angle), z};
}

}  // namespace

Face ruled_blade() {
  Face face;
  face.id = "F1";
  face.surface = ruled_between_rows(interpolated(ruled_blade_point, 16, 4).surface);
  return face;
}

Face twisted_blade() { return interpolated(twisted_blade_point, 20, 16); }

Face elliptic_side() { return interpolated(elliptic_side_point, 24, 8); }

}  // namespace flank::internal
