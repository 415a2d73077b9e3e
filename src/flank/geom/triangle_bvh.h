/// Closest point on a triangle mesh, exact in double precision.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "flank/triangle_mesh.h"

namespace flank::internal {

/// Closest point of the triangle (a, b, c) to p; barycentric weights of b and c are (u, v).
struct TrianglePoint {
  Vec3 point = Vec3::Zero();
  double u = 0.0, v = 0.0;
  double squared_distance = 0.0;
};

/// Ericson, Real-Time Collision Detection, 5.1.5. A triangle without area gives the closest point of one of its sides.
[[nodiscard]] TrianglePoint closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Closest triangle of a mesh and the point on it.
struct BvhHit : TrianglePoint {
  int triangle = -1;
};

/// Triangles that may be nearest within a slack: up to `kCapacity` of them, in the order in which they were found.
struct BvhTies {
  static constexpr int kCapacity = 68;
  std::array<int, kCapacity> triangle;  ///< indices; only the first `count` are set
  int count = 0;
  bool complete = true;  ///< false: more triangles than fit were that near
};

/// An 8-wide tree over groups of up to four triangles. A node is bounded by a flat disc along the mean normal of its
/// triangles: seen from far away that is much tighter than a box, whose corners reach out of the surface. Discs and a
/// first guess of each triangle's distance are in single precision with the rounding error on the safe side; only what
/// could be nearest is then measured in double precision. Immutable.
class TriangleBvh {
 public:
  TriangleBvh() = default;
  /// The mesh is copied in the tree's own order; it must not be empty and its coordinates must be finite.
  explicit TriangleBvh(const TriangleMesh& mesh);

  /// The nearest triangle and its closest point. Of triangles at exactly the same distance the one found first in the
  /// tree's order.
  [[nodiscard]] BvhHit closest(const Vec3& p) const;

  /// The same where it is no farther than `most`, which must be >= 0; else triangle is -1 and the distance `most`. Asking for less is faster.
  [[nodiscard]] BvhHit closest_within(const Vec3& p, double most) const;

  /// The nearest one as above, and in `ties` every triangle (among them the nearest) whose distance is at most `slack` above the least
  /// one; a few more may be there.
  [[nodiscard]] BvhHit closest(const Vec3& p, double slack, BvhTies& ties) const;

 private:
  /// What one search has found so far; how the tree is built. Both are in the source.
  struct Candidates;
  struct Builder;
  /// In double precision, for the final measurement.
  struct Corners {
    Vec3 a, b, c;
  };

  /// Bound of the error of a distance from p that is computed in single precision, mm.
  [[nodiscard]] double float_error(const Vec3& p) const;
  /// Measures the candidates in double precision.
  void measure(const Vec3& p, Candidates& found) const;
  /// Measures early if too many candidates are as near as the nearest.
  void make_room(const Vec3& p, Candidates& found) const;
  /// Collects the candidates; visit() asks one group of four triangles.
  void search(const Vec3& p, Candidates& found) const;
  /// q: p relative to center_, in single precision.
  void visit(const Vec3& p, const Eigen::Array3f& q, int group, Candidates& found) const;

  using Four = Eigen::Array4f;
  /// Children per node: what one vector instruction handles.
  static constexpr int kWidth = 8;
  using Wide = Eigen::Array<float, kWidth, 1>;
  // Round discs that hold the surface below them: centre, unit axis, radius and half thickness; child >= 0: node, < 0:
  // group -child - 1.
  struct Node {
    std::array<Wide, 3> center, axis;
    Wide radius, thickness;
    std::array<int, kWidth> child;
  };
  // Four triangles: corner a, the sides b - a and c - a, and 1 / |(b - a) x (c - a)|^2. Thin triangles have 0 there,
  // and `width` is at least the distance of their points from their sides.
  struct Group {
    std::array<Four, 3> a, ab, ac;
    Four inverse_det, width;
    bool thin;
  };

  /// Lower bounds of the squared distances to the children.
  static Wide bounds(const Node& n, const Eigen::Array3f& q);

  // Coordinates are taken relative to it, so that single precision is enough.
  Vec3 center_ = Vec3::Zero();
  double radius_ = 0.0;  // largest coordinate relative to the centre
  std::vector<Node> nodes_;
  std::vector<Group> groups_;
  std::vector<Corners> corners_;  // four a group
  std::vector<int> triangles_;    // four a group: number in the mesh, -1 in unused places
};

}  // namespace flank::internal
