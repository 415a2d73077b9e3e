#include "flank/obstacle/enclosure.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "flank/base/parallel.h"
#include "flank/obstacle/line_of_sight.h"

namespace flank::internal {
namespace {

constexpr int kPlaces = 256, kRays = 32;  ///< a share of 0.8 is known to 0.01
constexpr double kStartShare = 1e-6;      ///< of the size: nearer than this to its start a ray meets nothing

struct Place {
  Vec3 point, normal;
};

/// Places of equal shares of the area, each anywhere in its triangle.
std::vector<Place> places_on(const TriangleMesh& mesh) {
  // Roberts' sequence: even in two directions however many are taken.
  constexpr double kFirst = 0.7548776662466927, kSecond = 0.5698402909980532;
  std::vector<double> upto;
  double area = 0.0;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const auto t = corners_of(mesh, k);
    upto.push_back(area += 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm());
  }
  std::vector<Place> places;
  for (int i = 0; i < kPlaces; ++i) {
    const double at = area * (i + 0.5) / kPlaces;
    const auto k = static_cast<std::size_t>(std::upper_bound(upto.begin(), upto.end() - 1, at) - upto.begin());
    const auto t = corners_of(mesh, k);
    const double a = std::sqrt(std::fmod(kFirst * i, 1.0)), b = std::fmod(kSecond * i, 1.0);
    places.push_back(
        {(1.0 - a) * t[0] + a * (1.0 - b) * t[1] + a * b * t[2], (t[1] - t[0]).cross(t[2] - t[0]).normalized()});
  }
  return places;
}

/// The share of a place's rays that meet a triangle, about `normal`; `turn`: of the rays, radians.
double share_of(const TriangleTree& tree, const Place& place, const Vec3& normal, double turn, double least) {
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  const Vec3 x = normal.unitOrthogonal(), y = normal.cross(x);
  int met = 0;
  for (int k = 0; k < kRays; ++k) {
    const double r = std::sqrt((k + 0.5) / kRays), angle = golden * k + turn;
    const Vec3 direction = r * std::cos(angle) * x + r * std::sin(angle) * y + std::sqrt(1.0 - r * r) * normal;
    met += meets(tree, place.point, direction, least) ? 1 : 0;
  }
  return static_cast<double>(met) / kRays;
}

}  // namespace

Enclosure enclosure(const TriangleMesh& surface, const TriangleMesh& all) {
  const TriangleTree tree = tree_of(all);
  const double least = kStartShare * all.box().diagonal();
  const std::vector<Place> places = places_on(surface);
  std::vector<Enclosure> found(places.size());
  parallel_for(places.size(), [&](std::size_t k) {
    const Place& place = places[k];
    const double turn = static_cast<double>(k);  // so that no two places look the same way
    found[k] = {share_of(tree, place, place.normal, turn, least), share_of(tree, place, -place.normal, turn, least)};
  });
  Enclosure mean;
  for (const Enclosure& one : found) {
    mean.before += one.before / kPlaces;
    mean.behind += one.behind / kPlaces;
  }
  return mean;
}

}  // namespace flank::internal
