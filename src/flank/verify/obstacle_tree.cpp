#include "flank/verify/obstacle_tree.h"

#include <algorithm>
#include <numeric>

namespace flank::verify {
namespace {

constexpr int kLeaf = 3;
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
  for (int i : numbers_) {
    const auto v = corners_of(mesh, i);
    centers.emplace_back((v[0] + v[1] + v[2]) / 3.0);
  }
  nodes_.reserve(mesh.triangles.size());
  build(mesh, centers, 0, static_cast<int>(numbers_.size()));
  for (int i : numbers_) {
    corners_.push_back(corners_of(mesh, i));
    spheres_.push_back(sphere_of(corners_.back()));
  }
}

int ObstacleTree::build(const TriangleMesh& mesh, const std::vector<Vec3>& centers, int first, int end) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  node.first = first;
  node.end = end;
  Box3 box, middles;
  for (int k = first; k < end; ++k) {
    const int triangle = numbers_[static_cast<std::size_t>(k)];
    for (const Vec3& x : corners_of(mesh, triangle)) box.add(x);
    middles.add(centers[static_cast<std::size_t>(triangle)]);
  }
  node.sphere.center = box.center();
  for (int k = first; k < end; ++k)
    for (const Vec3& x : corners_of(mesh, numbers_[static_cast<std::size_t>(k)]))
      node.sphere.radius = std::max(node.sphere.radius, (x - node.sphere.center).norm() * kOutwards);
  if (end - first > kLeaf) {
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

}  // namespace flank::verify
