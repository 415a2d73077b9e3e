#include "flank/verify/clearance/obstacle_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace flank::internal::verify {
namespace {

constexpr int kLeaf = 3;  ///< most triangles of a leaf: a test of one costs about as much as two nodes
/// Of the radius: thickness of a slab that is worth testing. A thicker one is hardly a better bound than the sphere.
constexpr double kFlat = 0.25;
constexpr double kOutwards = 1.0 + 1e-12;  ///< rounding must not let a corner out of its sphere

std::array<Vec3, 3> corners_of(const TriangleMesh& mesh, int triangle) {
  const auto& t = mesh.triangles[static_cast<std::size_t>(triangle)];
  return {mesh.vertices[static_cast<std::size_t>(t[0])], mesh.vertices[static_cast<std::size_t>(t[1])],
          mesh.vertices[static_cast<std::size_t>(t[2])]};
}

/// About the middle of the longest side, which is best for right and blunt triangles and good for the others.
Sphere sphere_of(const std::array<Vec3, 3>& v) {
  std::size_t longest = 0;
  double most = -1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double side = (v[(k + 1) % 3] - v[k]).squaredNorm();
    if (side > most) most = side, longest = k;
  }
  Sphere sphere{0.5 * (v[longest] + v[(longest + 1) % 3]), 0.0};
  for (const Vec3& x : v) sphere.radius = std::max(sphere.radius, (x - sphere.center).norm() * kOutwards);
  return sphere;
}

}  // namespace

ObstacleTree::ObstacleTree(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return;
  numbers_.resize(mesh.triangles.size());
  std::iota(numbers_.begin(), numbers_.end(), 0);
  std::vector<Vec3> centers;
  centers.reserve(numbers_.size());
  for (int i : numbers_) {
    const auto v = corners_of(mesh, i);
    centers.emplace_back((v[0] + v[1] + v[2]) / 3.0);
  }
  nodes_.reserve(mesh.triangles.size());
  build(mesh, centers, 0, static_cast<int>(numbers_.size()));
  vertices_ = mesh.vertices;
  triangles_.reserve(numbers_.size());  // a vector that grows holds twice what it needs for a while
  for (int i : numbers_) triangles_.push_back(mesh.triangles[static_cast<std::size_t>(i)]);
}

Sphere ObstacleTree::sphere(int i) const { return sphere_of(corners(i)); }

/// Sphere and slab of the node's triangles. The slab lies across their mean normal, whichever way each of them is
/// oriented.
void ObstacleTree::enclose(const TriangleMesh& mesh, Node& node) const {
  Box3 box;
  Vec3 sum = Vec3::Zero();
  for (int k = node.first; k < node.end; ++k) {
    const auto v = corners_of(mesh, numbers_[static_cast<std::size_t>(k)]);
    for (const Vec3& x : v) box.add(x);
    const Vec3 normal = (v[1] - v[0]).cross(v[2] - v[0]);
    sum += normal.dot(sum) < 0.0 ? Vec3(-normal) : normal;
  }
  node.sphere.center = box.center();
  if (sum.norm() > 0.0) node.normal = sum.normalized();
  node.low = 1e300;
  node.high = -1e300;
  double farthest = 0.0;  // squared: one root a node, not one a corner
  for (int k = node.first; k < node.end; ++k) {
    for (const Vec3& x : corners_of(mesh, numbers_[static_cast<std::size_t>(k)])) {
      farthest = std::max(farthest, (x - node.sphere.center).squaredNorm());
      const double along = node.normal.dot(x);
      node.low = std::min(node.low, along);
      node.high = std::max(node.high, along);
    }
  }
  node.sphere.radius = std::sqrt(farthest) * kOutwards;
  node.flat = node.high - node.low < kFlat * node.sphere.radius;
}

/// Halves by the middles of the triangles along their longest extent. Ties go by number: the tree, and with it every
/// answer, is the same each time.
int ObstacleTree::build(const TriangleMesh& mesh, const std::vector<Vec3>& centers, int first, int end) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  node.first = first;
  node.end = end;
  enclose(mesh, node);
  if (end - first > kLeaf) {
    Box3 middles;
    for (int k = first; k < end; ++k)
      middles.add(centers[static_cast<std::size_t>(numbers_[static_cast<std::size_t>(k)])]);
    int axis = 0;
    (middles.high - middles.low).maxCoeff(&axis);
    const int middle = first + (end - first) / 2;
    const auto at = [&](int k) { return numbers_.begin() + k; };
    std::nth_element(at(first), at(middle), at(end), [&](int a, int b) {
      const double ka = centers[static_cast<std::size_t>(a)][axis], kb = centers[static_cast<std::size_t>(b)][axis];
      return ka < kb || (ka == kb && a < b);
    });
    build(mesh, centers, first, middle);
    node.second = build(mesh, centers, middle, end);
  }
  nodes_[static_cast<std::size_t>(index)] = node;
  return index;
}

}  // namespace flank::internal::verify
