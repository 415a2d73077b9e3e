#include "flank/obstacle/line_of_sight.h"

#include <limits>
#include <vector>

namespace flank::internal {
namespace {

/// Moeller and Trumbore 1997: how far along a ray the triangle is met; infinite where it is not.
double way_to(const std::array<Vec3, 3>& t, const Vec3& from, const Vec3& direction) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], across = direction.cross(ac), to = from - t[0];
  const double det = ab.dot(across);
  if (det == 0.0) return kNone;
  const double u = to.dot(across) / det;
  const Vec3 q = to.cross(ab);
  const double v = direction.dot(q) / det;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 ? ac.dot(q) / det : kNone;
}

}  // namespace

std::array<Vec3, 3> corners_of(const TriangleMesh& mesh, std::size_t triangle) {
  const std::array<int, 3>& t = mesh.triangles[triangle];
  return {mesh.vertices[static_cast<std::size_t>(t[0])], mesh.vertices[static_cast<std::size_t>(t[1])],
          mesh.vertices[static_cast<std::size_t>(t[2])]};
}

TriangleTree tree_of(const TriangleMesh& mesh) {
  std::vector<TriangleTree::Triangle> triangles(mesh.triangles.size());
  for (std::size_t k = 0; k < triangles.size(); ++k) triangles[k].corners = corners_of(mesh, k);
  return TriangleTree(std::move(triangles));
}

bool meets(const TriangleTree& tree, const Vec3& from, const Vec3& direction, double least_mm) {
  if (tree.empty()) return false;
  const Vec3 per_mm = direction.cwiseInverse();  // infinite along an axis: the comparisons hold all the same
  std::vector<int> open{0};
  while (!open.empty()) {
    const int index = open.back();
    open.pop_back();
    const TriangleTree::Node& node = tree.nodes()[static_cast<std::size_t>(index)];
    const Vec3 a = (node.center - node.half - from).cwiseProduct(per_mm),
               b = (node.center + node.half - from).cwiseProduct(per_mm);
    if (a.cwiseMax(b).minCoeff() < std::max(0.0, a.cwiseMin(b).maxCoeff())) continue;
    if (node.second >= 0) {
      open.push_back(node.second);
      open.push_back(index + 1);
      continue;
    }
    for (int k = node.first; k < node.end; ++k) {
      const double way = way_to(tree.triangles()[static_cast<std::size_t>(k)].corners, from, direction);
      if (way > least_mm && way < std::numeric_limits<double>::infinity()) return true;
    }
  }
  return false;
}

}  // namespace flank::internal
