#include "flank/example/example_rotor37.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/example/example_rotor37_table.h"

namespace flank::internal {
namespace {

constexpr double kDegreesToRad = 3.14159265358979323846 / 180.0;
constexpr int kDegree = 3;

/// Between these stations (counted from 0) a point belongs to a side, beyond them to an edge.
constexpr int kSideFirst = 12, kSideLast = 87;
/// Points that a side's surface goes through in each section. Through all 76 it would follow the table's last digit.
constexpr int kSidePoints = 36;
/// Stations from one to the next point of an edge; there are four of them between a side and the tip of the edge.
constexpr int kEdgeStep = 3;
/// How deep the blade of the blisk reaches into the hub, in steps from the first section to the second.
constexpr double kRootDepth = 0.25;
/// The points of the hub's outline at which the blisk ends.
constexpr int kHubFirst = 5, kHubLast = 20;
constexpr double kBoreRadiusMm = 150.0;
constexpr double kSectorFromRad = -22.0 * kDegreesToRad, kSectorToRad = 27.0 * kDegreesToRad;
/// A lid is ruled from side to side except near its ends, where it bends to the curves of the edges: the difference
/// fades as (1 - u)^12 from the leading and as u^12 from the trailing edge.
constexpr int kLidPower = 12;

/// The points of one section's stations, of side 1 and side 2.
using Section = std::vector<std::array<Vec3, 2>>;

/// Where a point of a face stands in the table.
struct Place {
  int station, side;
  [[nodiscard]] const Vec3& in(const Section& section) const {
    return section[static_cast<std::size_t>(station)][static_cast<std::size_t>(side)];
  }
};

/// From the hub, or below it, to the shroud.
std::vector<Section> sections(Rotor37Root root) {
  std::vector<Section> all;
  for (int k = 0; k < kRotor37Sections; ++k) {
    Section& section = all.emplace_back();
    for (const Rotor37Station& station : rotor37_section(k)) section.push_back({station.point(0), station.point(1)});
  }
  if (root == Rotor37Root::kAtTheHub) return all;
  Section below = all[0];
  for (std::size_t i = 0; i < below.size(); ++i)
    for (std::size_t side = 0; side < 2; ++side) below[i][side] -= kRootDepth * (all[1][i][side] - all[0][i][side]);
  all.insert(all.begin(), below);
  return all;
}

/// Points of a side, from the leading to the trailing edge.
std::vector<Place> side_places(int side) {
  std::vector<Place> places;
  for (int k = 0; k < kSidePoints; ++k) {
    const double share = static_cast<double>(k) / (kSidePoints - 1);
    places.push_back({kSideFirst + static_cast<int>(std::lround(share * (kSideLast - kSideFirst))), side});
  }
  return places;
}

/// Points of an edge, from side `side` at station `from` to the tip of the edge at `tip` and back on the other side. At
/// the tip the table's two angles differ in their last digit: side 1 counts.
std::vector<Place> edge_places(int from, int tip, int side) {
  std::vector<Place> places;
  const int step = tip > from ? kEdgeStep : -kEdgeStep;
  for (int station = from; station != tip; station += step) places.push_back({station, side});
  places.push_back({tip, 0});
  for (int station = tip - step; station != from; station -= step) places.push_back({station, 1 - side});
  places.push_back({from, 1 - side});
  return places;
}

/// The points of F1 to F4, once round the blade.
std::vector<std::vector<Place>> skin_places() {
  std::vector<Place> back = side_places(1);
  std::reverse(back.begin(), back.end());
  return {side_places(0), edge_places(kSideLast, kRotor37Stations - 1, 0), back, edge_places(kSideFirst, 0, 1)};
}

/// Sums of steps from 0, as shares of their whole.
std::vector<double> shares(const std::vector<double>& steps) {
  std::vector<double> sums{0.0};
  for (const double step : steps) sums.push_back(sums.back() + step);
  for (double& sum : sums) sum /= sums.back();
  sums.back() = 1.0;
  return sums;
}

/// Parameters of a face's points along a section: shares of the length, of the mean over all sections.
std::vector<double> shares_along(const std::vector<Section>& all, const std::vector<Place>& places) {
  std::vector<double> steps(places.size() - 1, 0.0);
  for (const Section& section : all)
    for (std::size_t i = 0; i < steps.size(); ++i) steps[i] += (places[i + 1].in(section)-places[i].in(section)).norm();
  return shares(steps);
}

/// Parameters of the sections: shares of the way from the hub to the shroud, of the mean over all stations.
std::vector<double> shares_up(const std::vector<Section>& all) {
  std::vector<double> steps(all.size() - 1, 0.0);
  for (std::size_t k = 0; k < steps.size(); ++k)
    for (std::size_t i = 0; i < all[k].size(); ++i) {
      const std::size_t sides = i == 0 || i + 1 == all[k].size() ? 1 : 2;
      for (std::size_t side = 0; side < sides; ++side) steps[k] += (all[k + 1][i][side] - all[k][i][side]).norm();
    }
  return shares(steps);
}

std::vector<double> backwards(std::vector<double> parameters) {
  std::reverse(parameters.begin(), parameters.end());
  for (double& x : parameters) x = 1.0 - x;
  return parameters;
}

/// Opposite faces of the skin run against each other and share their parameters, so that the lids fit to both.
std::vector<Face> skin(Rotor37Root root) {
  const std::vector<Section> all = sections(root);
  const std::vector<std::vector<Place>> places = skin_places();
  const std::vector<double> v = shares_up(all);
  std::vector<Face> faces;
  for (std::size_t k = 0; k < places.size(); ++k) {
    std::vector<double> u = shares_along(all, places[k]);
    const std::vector<double> other = backwards(shares_along(all, places[(k + 2) % 4]));
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = 0.5 * (u[i] + other[i]);
    std::vector<Vec3> points;
    for (const Place& place : places[k])
      for (const Section& section : all) points.push_back(place.in(section));
    faces.emplace_back().surface = interpolate_grid(points, u, v, kDegree);
  }
  return faces;
}

/// The lid over the lower (row 0) or upper border of the skin: lines from side to side, bent at the ends to the edges.
Face lid(const std::vector<Face>& skin, int row) {
  const BSplineSurface &front = skin[0].surface, &trailing = skin[1].surface, &back = skin[2].surface,
                       &leading = skin[3].surface;
  Face face;
  BSplineSurface& s = face.surface;
  s.degree_u = s.degree_v = kDegree;
  s.count_u = front.count_u;
  s.count_v = trailing.count_u;
  s.knots_u = front.knots_u;
  s.knots_v = trailing.knots_u;
  const std::vector<double> u = greville_sites(s.knots_u, kDegree), v = greville_sites(s.knots_v, kDegree);
  const auto line = [&](int i, double share) {
    return Vec3((1.0 - share) * front.pole(i, row) + share * back.pole(s.count_u - 1 - i, row));
  };
  for (int i = 0; i < s.count_u; ++i) {
    const double x = u[static_cast<std::size_t>(i)];
    for (int j = 0; j < s.count_v; ++j) {
      const double y = v[static_cast<std::size_t>(j)];
      s.poles.push_back(line(i, y) +
                        std::pow(1.0 - x, kLidPower) * (leading.pole(s.count_v - 1 - j, row) - line(0, y)) +
                        std::pow(x, kLidPower) * (trailing.pole(j, row) - line(s.count_u - 1, y)));
    }
  }
  face.reversed = row == 0;
  return face;
}

std::vector<Face> turned(std::vector<Face> faces, double angle_rad) {
  const Eigen::AngleAxisd turn(angle_rad, Vec3::UnitX());
  for (Face& face : faces)
    for (Vec3& pole : face.surface.poles) pole = turn * pole;
  return faces;
}

}  // namespace

std::vector<Face> rotor37_faces(Rotor37Root root) {
  std::vector<Face> faces = skin(root);
  const Face low = lid(faces, 0), high = lid(faces, faces[0].surface.count_v - 1);
  faces.push_back(low);
  faces.push_back(high);
  for (std::size_t k = 0; k < faces.size(); ++k) faces[k].id = "F" + std::to_string(k + 1);
  return faces;
}

SolidModel rotor37_blade() { return sew_solid("rotor37", rotor37_faces()); }

SolidModel rotor37_blisk(int blades) {
  const std::vector<Vec2> outline = rotor37_hub();
  HubSector hub;
  hub.profile.assign(outline.begin() + kHubFirst, outline.begin() + kHubLast + 1);
  hub.bore_radius_mm = kBoreRadiusMm;
  hub.from_rad = kSectorFromRad;
  hub.to_rad =
      blades == kRotor37Blades ? hub.from_rad + 360.0 * kDegreesToRad : kSectorToRad + (blades - 2) * kRotor37PitchRad;
  const std::vector<Face> blade = rotor37_faces(Rotor37Root::kInsideTheHub);
  std::vector<std::vector<Face>> all;
  for (int k = 0; k < blades; ++k) all.push_back(turned(blade, k * kRotor37PitchRad));
  return fuse_blisk("rotor37-blisk", hub, all);
}

}  // namespace flank::internal
