#include "flank/geom/bvh.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

/// Above this many items a node is bounded by the boxes of its items instead of their hulls: the loss is small and
/// building stays quick.
constexpr int kExactItems = 48;

}  // namespace

OrientedBox bounding_box(const std::vector<Vec3>& points) {
  OrientedBox box;
  if (points.empty()) return box;
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Vec3& p : points) covariance += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  if (solver.info() == Eigen::Success && solver.eigenvectors().allFinite())
    box.axes = solver.eigenvectors().transpose();
  Box3 local;
  for (const Vec3& p : points) local.add(box.axes * (p - mean));
  box.center = mean + box.axes.transpose() * local.center();
  // Round-off of the frame must not let a point out.
  const double slack = 1e-14 * (mean.cwiseAbs().maxCoeff() + local.diagonal());
  box.half = 0.5 * (local.high - local.low) + Vec3::Constant(slack);
  return box;
}

void append_corners(const OrientedBox& box, std::vector<Vec3>& points) {
  for (int k = 0; k < 8; ++k) {
    const Vec3 sign((k & 1) ? 1.0 : -1.0, (k & 2) ? 1.0 : -1.0, (k & 4) ? 1.0 : -1.0);
    points.push_back(box.center + box.axes.transpose() * box.half.cwiseProduct(sign));
  }
}

BoxTree::BoxTree(const std::vector<std::vector<Vec3>>& hulls) {
  if (hulls.empty()) return;
  std::vector<int> items(hulls.size());
  std::iota(items.begin(), items.end(), 0);
  nodes_.reserve(2 * hulls.size());
  build(hulls, items, 0, static_cast<int>(items.size()));
}

int BoxTree::build(const std::vector<std::vector<Vec3>>& hulls, std::vector<int>& items, int begin, int end) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  if (end - begin == 1) {
    nodes_.back().item = items[static_cast<std::size_t>(begin)];
    nodes_.back().box = bounding_box(hulls[static_cast<std::size_t>(nodes_.back().item)]);
    return index;
  }
  Box3 centers;
  // A hull's first and last point stand for its place: opposite corners of a patch of control points.
  const auto key = [&](int item, int axis) {
    const auto& hull = hulls[static_cast<std::size_t>(item)];
    return hull.front()[axis] + hull.back()[axis];
  };
  for (int k = begin; k < end; ++k) {
    const int item = items[static_cast<std::size_t>(k)];
    centers.add(Vec3(key(item, 0), key(item, 1), key(item, 2)));
  }
  int axis = 0;
  // Halves of equal count across the longest side: the depth is the logarithm of the number, which kStack relies on.
  (centers.high - centers.low).maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  std::nth_element(items.begin() + begin, items.begin() + middle, items.begin() + end, [&](int a, int b) {
    const double ka = key(a, axis), kb = key(b, axis);
    return ka < kb || (ka == kb && a < b);
  });
  const int left = build(hulls, items, begin, middle);
  const int right = build(hulls, items, middle, end);
  std::vector<Vec3> points;
  if (end - begin <= kExactItems) {
    for (int k = begin; k < end; ++k) {
      const auto& hull = hulls[static_cast<std::size_t>(items[static_cast<std::size_t>(k)])];
      points.insert(points.end(), hull.begin(), hull.end());
    }
  } else {
    append_corners(nodes_[static_cast<std::size_t>(left)].box, points);
    append_corners(nodes_[static_cast<std::size_t>(right)].box, points);
  }
  Node& node = nodes_[static_cast<std::size_t>(index)];
  node.left = left;
  node.right = right;
  node.box = bounding_box(points);
  return index;
}

}  // namespace flank::internal
