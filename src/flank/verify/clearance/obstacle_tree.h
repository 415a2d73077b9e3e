/// A tree of spheres over the triangles that a body must keep clear of. It asks nothing of the mesh: closed or open,
/// overlapping itself, oriented in any way.
#pragma once

#include <array>
#include <vector>

#include "flank/triangle_mesh.h"

namespace flank::internal::verify {

/// mm, in the part's frame.
struct Sphere {
  Vec3 center = Vec3::Zero();
  double radius = 0.0;
};

/// Built once, then immutable. Nodes are in depth-first order, node 0 is the root; an empty mesh has none.
class ObstacleTree {
 public:
  /// A node holds triangles [first, end); its children are the next node and `second` (-1: a leaf). All of it lies in
  /// the slab low <= <normal, x> <= high.
  struct Node {
    Sphere sphere;
    Vec3 normal = Vec3::UnitZ();
    double low = 0.0, high = 0.0;
    bool flat = false;  ///< the slab is thin for the node's size
    int second = -1, first = 0, end = 0;
  };

  ObstacleTree() = default;
  /// Copies what it needs of the mesh.
  explicit ObstacleTree(const TriangleMesh& mesh);

  /// No triangles: nothing to keep clear of.
  [[nodiscard]] bool empty() const { return triangles_.empty(); }
  [[nodiscard]] int node_count() const { return static_cast<int>(nodes_.size()); }
  [[nodiscard]] const Node& node(int i) const { return nodes_[static_cast<std::size_t>(i)]; }
  /// Triangles are counted in the tree's order.
  [[nodiscard]] std::array<Vec3, 3> corners(int i) const {
    const auto& t = triangles_[static_cast<std::size_t>(i)];
    return {vertices_[static_cast<std::size_t>(t[0])], vertices_[static_cast<std::size_t>(t[1])],
            vertices_[static_cast<std::size_t>(t[2])]};
  }
  /// The sphere around one triangle. Made when it is asked for: trees of millions of triangles are most of a judge's memory.
  [[nodiscard]] Sphere sphere(int i) const;
  /// Its number in the mesh.
  [[nodiscard]] int number(int i) const { return numbers_[static_cast<std::size_t>(i)]; }

 private:
  /// Sets sphere and slab of a node from its triangles.
  void enclose(const TriangleMesh& mesh, Node& node) const;
  /// Builds the subtree over triangles [first, end) and returns its node.
  int build(const TriangleMesh& mesh, const std::vector<Vec3>& centers, int first, int end);

  std::vector<Node> nodes_;
  std::vector<Vec3> vertices_;
  /// The last two: per triangle, in the tree's order.
  std::vector<int> numbers_;
  std::vector<std::array<int, 3>> triangles_;
};

}  // namespace flank::internal::verify
