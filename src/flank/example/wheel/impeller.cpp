#include "flank/example/wheel/impeller.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace flank::internal {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kStations = 14, kHeights = 6, kDegree = 3;
/// The chord of a splitter begins here, as a share of the main blade's.
constexpr double kSplitterFrom = 0.4;
constexpr double kLengthMm = 30.0, kWrapRad = 35.0 * kPi / 180.0, kLeanRad = 8.0 * kPi / 180.0;
/// At the hub and at the tip.
constexpr double kRootThicknessMm = 2.4, kTipThicknessMm = 1.4;
/// How deep a blade reaches into the hub, as a share of its height: the thickness leads from the camber to where the hub
/// is lower, and the root must lie inside there, too.
constexpr double kRootDepth = 0.25;
constexpr double kBoreRadiusMm = 8.0;
constexpr int kHubPoints = 14;
/// The hub goes on before and behind the blades by this share of their length.
constexpr double kHubBeyond = 0.15;
constexpr double kStep = 1e-5;

/// Of the hub and of the shroud at the share s of the length: mm.
double hub_radius(double s) { return 16.0 + 16.0 * s * s; }
double tip_radius(double s) { return 36.0 + 6.0 * s * s; }

/// The camber surface: s along the chord, h from the hub to the tip.
Vec3 camber(double s, double h) {
  const double radius = std::lerp(hub_radius(s), tip_radius(s), h);
  const double angle = kWrapRad * (s - 0.25 * s * (1.0 - s)) * (1.0 + 0.35 * h) + kLeanRad * h;
  return {kLengthMm * s, radius * std::cos(angle), radius * std::sin(angle)};
}

/// A point of the side that looks towards growing angles (side +1) or back (-1).
Vec3 side_point(double s, double h, int side) {
  const Vec3 along = camber(s + kStep, h) - camber(s - kStep, h), up = camber(s, h + kStep) - camber(s, h - kStep);
  const Vec3 normal = along.cross(up).normalized();
  return camber(s, h) + 0.5 * side * std::lerp(kRootThicknessMm, kTipThicknessMm, h) * normal;
}

std::vector<double> even(int count) {
  std::vector<double> shares;
  for (int k = 0; k < count; ++k) shares.push_back(static_cast<double>(k) / (count - 1));
  return shares;
}

/// Side +1 from the leading to the trailing edge, side -1 back again, so that both look outwards alike.
Face side_face(double from, int side) {
  std::vector<Vec3> points;
  for (int i = 0; i < kStations; ++i)
    for (int j = 0; j < kHeights; ++j) {
      const double share = static_cast<double>(side > 0 ? i : kStations - 1 - i) / (kStations - 1);
      const double h = std::lerp(-kRootDepth, 1.0, static_cast<double>(j) / (kHeights - 1));
      points.push_back(side_point(std::lerp(from, 1.0, share), h, side));
    }
  Face face;
  face.surface = interpolate_grid(points, even(kStations), even(kHeights), kDegree);
  return face;
}

/// Ruled between two curves that share their knots: `a` at the first, `b` at the last parameter u.
Face ruled(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const std::vector<double>& knots) {
  Face face;
  BSplineSurface& s = face.surface;
  s.degree_u = 1;
  s.degree_v = kDegree;
  s.knots_u = {0.0, 0.0, 1.0, 1.0};
  s.knots_v = knots;
  s.count_u = 2;
  s.count_v = static_cast<int>(a.size());
  s.poles = a;
  s.poles.insert(s.poles.end(), b.begin(), b.end());
  return face;
}

std::vector<Vec3> column(const BSplineSurface& s, int i) {
  std::vector<Vec3> poles;
  for (int j = 0; j < s.count_v; ++j) poles.push_back(s.pole(i, j));
  return poles;
}
std::vector<Vec3> row(const BSplineSurface& s, int j, bool back) {
  std::vector<Vec3> poles;
  for (int i = 0; i < s.count_u; ++i) poles.push_back(s.pole(back ? s.count_u - 1 - i : i, j));
  return poles;
}

}  // namespace

std::vector<Face> impeller_blade(double from, double angle_rad) {
  const Face front = side_face(from, 1), back = side_face(from, -1);
  const BSplineSurface &a = front.surface, &b = back.surface;
  std::vector<Face> faces{front, ruled(column(a, a.count_u - 1), column(b, 0), a.knots_v), back,
                          ruled(column(b, b.count_u - 1), column(a, 0), a.knots_v)};
  for (const int j : {0, a.count_v - 1}) {
    Face lid = ruled(row(a, j, false), row(b, j, true), a.knots_u);
    // Their parameters run across the blade and along it: the normal of the upper one looks inwards.
    lid.reversed = j != 0;
    faces.push_back(std::move(lid));
  }
  const Eigen::AngleAxisd turn(angle_rad, Vec3::UnitX());
  for (std::size_t k = 0; k < faces.size(); ++k) {
    faces[k].id = "F" + std::to_string(k + 1);
    for (Vec3& pole : faces[k].surface.poles) pole = turn * pole;
  }
  return faces;
}

SolidModel impeller() {
  HubSector hub;
  for (int k = 0; k < kHubPoints; ++k) {
    const double s = std::lerp(-kHubBeyond, 1.0 + kHubBeyond, static_cast<double>(k) / (kHubPoints - 1));
    hub.profile.emplace_back(kLengthMm * s, hub_radius(s));
  }
  hub.bore_radius_mm = kBoreRadiusMm;
  hub.from_rad = -0.35 * kImpellerPitchRad;
  hub.to_rad = (kImpellerPairs + 0.45) * kImpellerPitchRad;
  std::vector<std::vector<Face>> blades;
  for (int k = 0; k < kImpellerPairs; ++k) {
    blades.push_back(impeller_blade(0.0, k * kImpellerPitchRad));
    blades.push_back(impeller_blade(kSplitterFrom, (k + 0.5) * kImpellerPitchRad));
  }
  return fuse_blisk("impeller", hub, blades);
}

}  // namespace flank::internal
