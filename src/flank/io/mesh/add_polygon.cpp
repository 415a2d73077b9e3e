#include "flank/io/mesh/add_polygon.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "flank/error.h"

namespace flank::internal {
namespace {

/// Ears are found in the square of the corners at best, in the cube at worst.
constexpr int kMostConcaveCorners = 2000;

/// The corners in the plane of the polygon, counter-clockwise; none if it has no area, or corners that the mesh has not.
std::vector<Eigen::Vector2d> in_plane(const TriangleMesh& mesh, const int* corners, int count) {
  const auto known = static_cast<int>(mesh.vertices.size());
  if (std::any_of(corners, corners + count, [&](int v) { return v < 0 || v >= known; })) return {};
  const auto corner = [&](int k) { return mesh.vertices[static_cast<std::size_t>(corners[k % count])]; };
  Vec3 normal = Vec3::Zero();  // twice the area (Newell); from the first corner, so that nothing large cancels
  for (int k = 1; k + 1 < count; ++k) normal += (corner(k) - corner(0)).cross(corner(k + 1) - corner(0));
  if (!(normal.norm() > 0.0)) return {};
  const Vec3 x = normal.unitOrthogonal(), y = normal.normalized().cross(x);
  std::vector<Eigen::Vector2d> points;
  for (int k = 0; k < count; ++k) points.emplace_back(x.dot(corner(k) - corner(0)), y.dot(corner(k) - corner(0)));
  return points;
}

/// Twice the signed area.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// All turns to the left, and once round: a star turns left everywhere, too.
bool is_convex(const std::vector<Eigen::Vector2d>& p) {
  const std::size_t n = p.size();
  for (std::size_t k = 0; k < n; ++k)
    if (turn(p[k], p[(k + 1) % n], p[(k + 2) % n]) < 0.0) return false;
  for (std::size_t k = 1; k + 1 < n; ++k)
    if (turn(p[0], p[k], p[k + 1]) < 0.0) return false;
  return true;
}

/// The corner at `k` of what is left is an ear: it turns left, and no other corner lies in its triangle.
bool is_ear(const std::vector<Eigen::Vector2d>& p, const std::vector<int>& left, std::size_t k) {
  const std::size_t n = left.size();
  const auto at = [&](std::size_t i) { return p[static_cast<std::size_t>(left[i % n])]; };
  const Eigen::Vector2d a = at(k + n - 1), b = at(k), c = at(k + 1);
  if (!(turn(a, b, c) > 0.0)) return false;
  for (std::size_t i = k + 2; i + 1 < k + n; ++i) {
    const Eigen::Vector2d q = at(i);
    if (q != a && q != b && q != c && turn(a, b, q) >= 0.0 && turn(b, c, q) >= 0.0 && turn(c, a, q) >= 0.0)
      return false;
  }
  return true;
}

}  // namespace

void add_polygon(TriangleMesh& mesh, const int* corners, int count) {
  std::vector<Eigen::Vector2d> points;
  if (count > 3) points = in_plane(mesh, corners, count);
  if (points.empty() || is_convex(points)) {
    for (int k = 2; k < count; ++k) mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
    return;
  }
  if (count > kMostConcaveCorners)
    throw InputError(fmt::format("a polygon of {} corners is not convex; export triangles", count));
  std::vector<int> left(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) left[static_cast<std::size_t>(k)] = k;
  for (std::size_t k = 0; left.size() > 2;) {
    // Without an ear the polygon crosses itself: any corner does.
    std::size_t tried = 0;
    while (tried < left.size() && !is_ear(points, left, k % left.size())) ++k, ++tried;
    const std::size_t n = left.size(), ear = k % n;
    const auto vertex = [&](std::size_t i) { return corners[left[i % n]]; };
    mesh.triangles.push_back({vertex(ear + n - 1), vertex(ear), vertex(ear + 1)});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
    k = ear;
  }
}

}  // namespace flank::internal
