/// Which faces of a part are joined smoothly, and along how much of their borders.
#pragma once

#include <memory>
#include <set>
#include <vector>

#include "flank/part.h"
#include "flank/target.h"

namespace flank::internal {

/// Faces are joined smoothly where their normals differ by no more than this along a border that they share.
inline constexpr double kSkinAngleDeg = 5.0;

struct EdgePoint {
  Vec3 point, normal;
  double bend = 0.0;  ///< larger principal curvature, 1/mm, positive where the face bends towards its normal
};

/// Points of one edge of a face, with the face's normal.
struct FaceEdge {
  std::vector<EdgePoint> points;
  double length_mm = 0.0;
  Box3 box;  ///< of the edge, with a margin for what it does between the points
};

/// What takes time is made once for each face, when it is asked for. Not for a mesh.
class Joints {
 public:
  explicit Joints(const Part& part);

  /// Those of the faces that are not in `known`, ascending.
  [[nodiscard]] std::vector<int> joined_to(int face, const std::set<int>& known);
  [[nodiscard]] const std::vector<FaceEdge>& border(int face) const { return borders_[static_cast<std::size_t>(face)]; }
  /// Length of the border that the two share smoothly, mm; 0 if they are not joined.
  [[nodiscard]] double joined_mm(int face, int other);
  /// Larger principal curvature, 1/mm, that half of the face exceeds.
  [[nodiscard]] double bend(int face);
  /// Its surface, machined from its outward side.
  [[nodiscard]] const Target& target(int face);
  /// May they share an edge? Quick, and sometimes wrongly yes.
  [[nodiscard]] bool borders_meet(int a, int b) const;

 private:
  void prepare(int face);

  const Part& part_;
  double near_ = 0.0;  ///< what touches, mm
  std::vector<std::vector<FaceEdge>> borders_;
  std::vector<std::unique_ptr<Target>> targets_;
  std::vector<double> bends_;
};

/// Faces that hang together along their borders, and are not pieces of one face; of a mesh all are one group. In the order of `faces`.
[[nodiscard]] std::vector<std::vector<int>> connected_groups(const Part& part, const std::vector<int>& faces);

}  // namespace flank::internal
