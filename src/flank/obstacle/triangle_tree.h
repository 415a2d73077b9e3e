/// Boxes over the triangles that a planned pose must keep clear of.
#pragma once

#include <array>
#include <vector>

#include "flank/triangle_mesh.h"

namespace flank::internal {

/// Immutable after construction. Its users walk the nodes themselves, since what bounds a node depends on the body.
class TriangleTree {
 public:
  struct Node {
    Vec3 center, half;       ///< the box: centre and half its sides, mm
    int second = -1;         ///< index of the second child; the first child follows its parent; -1: a leaf
    int first = 0, end = 0;  ///< its triangles: [first, end)
  };
  struct Triangle {
    std::array<Vec3, 3> corners;
    int surface = 0;        ///< whose it is
    double slack_mm = 0.0;  ///< this much is taken off the distance of the triangle
  };

  TriangleTree() = default;  ///< empty
  /// Takes the triangles and sorts them; node 0 is the root.
  explicit TriangleTree(std::vector<Triangle> triangles);

  [[nodiscard]] bool empty() const { return triangles_.empty(); }
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
  /// Of all triangles: to be taken off the distance of any box.
  [[nodiscard]] double largest_slack() const { return slack_; }

 private:
  int build(int first, int end);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
  double slack_ = 0.0;
};

}  // namespace flank::internal
