/// Whether a point lies inside a closed solid, by the winding number of its triangles.
#pragma once

#include <memory>
#include <vector>

#include "flank/verify/clearance/obstacle_tree.h"

namespace flank::internal::verify {

/// Generalised winding number (Jacobson, Kavan and Sorkine-Hornung, 2013): about 1 inside a closed mesh that is
/// oriented outwards, -1 inside one that is oriented inwards, 0 outside; gaps of the width of a triangulation error
/// change it little. Far parts count as one area each (Barill et al., 2018).
class Winding {
 public:
  /// Copies what it needs of the mesh; an empty one winds round nothing.
  explicit Winding(const TriangleMesh& mesh);
  /// Of triangles that have a tree already, which is shared. Numbers of the faces of a solid add up to that of the solid.
  explicit Winding(std::shared_ptr<const ObstacleTree> tree);

  /// Good to about 0.05 for points that are farther from the triangles than their gaps are wide.
  [[nodiscard]] double number(const Vec3& x) const;
  /// More than half wound round, whichever way the solid is oriented.
  [[nodiscard]] bool inside(const Vec3& x) const;

 private:
  /// The triangles of a node of the tree as one oriented area.
  struct Area {
    Vec3 center = Vec3::Zero(), vector = Vec3::Zero();
    double radius = 0.0;  ///< no corner is farther from the centre
  };

  std::shared_ptr<const ObstacleTree> tree_;
  std::vector<Area> areas_;  ///< of each node
};

}  // namespace flank::internal::verify
