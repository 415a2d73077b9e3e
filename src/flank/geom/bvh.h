/// A hierarchy of oriented boxes for nearest-point queries.
#pragma once

#include <cmath>
#include <vector>

#include "flank/vec.h"

namespace flank::internal {

/// A box in its own frame.
struct OrientedBox {
  Vec3 center = Vec3::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< one unit axis a row
  /// Half lengths along the axes, >= 0.
  Vec3 half = Vec3::Zero();

  /// Squared distance from p to the box, 0 inside.
  [[nodiscard]] double squared_distance(const Vec3& p) const {
    const Vec3 d = p - center;
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double x = std::abs(axes(k, 0) * d[0] + axes(k, 1) * d[1] + axes(k, 2) * d[2]) - half[k];
      if (x > 0.0) sum += x * x;
    }
    return sum;
  }
};

/// Box along the principal axes of the points, holding all of them.
[[nodiscard]] OrientedBox bounding_box(const std::vector<Vec3>& points);

/// Appends the eight corners of a box.
void append_corners(const OrientedBox& box, std::vector<Vec3>& points);

/// Binary tree over items, each given by points whose convex hull holds it.
class BoxTree {
 public:
  BoxTree() = default;
  /// Item k is hulls[k], at least one point each. Each must lie within the convex hull of its points.
  explicit BoxTree(const std::vector<std::vector<Vec3>>& hulls);

  /// Visits the items that can be nearer to p than the squared distance `best`, nearest boxes first. visit(item) may
  /// lower `best`.
  template <class Visit>
  void nearest(const Vec3& p, double& best, Visit&& visit) const;

 private:
  struct Node {
    OrientedBox box;
    int left = -1, right = -1;  ///< children; left < 0: a leaf
    /// Of a leaf.
    int item = -1;
  };
  /// Builds the subtree over items [begin, end) and returns its node.
  int build(const std::vector<std::vector<Vec3>>& hulls, std::vector<int>& items, int begin, int end);

  static constexpr int kStack = 128;  ///< the tree is balanced: its depth is the logarithm of its size
  /// Node 0 is the root.
  std::vector<Node> nodes_;
};

template <class Visit>
void BoxTree::nearest(const Vec3& p, double& best, Visit&& visit) const {
  if (nodes_.empty()) return;
  // Depth first, the nearer child first: the farther one waits on the stack with its bound.
  struct Entry {
    double bound;
    int node;
  };
  Entry stack[kStack];
  int size = 0;
  stack[size++] = {nodes_[0].box.squared_distance(p), 0};
  while (size > 0) {
    Entry entry = stack[--size];
    // `best` may have fallen since the entry was pushed, so it is compared again here.
    while (entry.bound < best) {
      const Node& node = nodes_[static_cast<std::size_t>(entry.node)];
      if (node.left < 0) {
        visit(node.item);
        break;
      }
      Entry near{nodes_[static_cast<std::size_t>(node.left)].box.squared_distance(p), node.left};
      Entry far{nodes_[static_cast<std::size_t>(node.right)].box.squared_distance(p), node.right};
      if (far.bound < near.bound) std::swap(near, far);
      if (far.bound < best) stack[size++] = far;
      entry = near;
    }
  }
}

}  // namespace flank::internal
