/// What a tool must not enter at one target: the value from which both planners work (docs/decisions/0013). The judge
/// has an idea of its own (decision 0003).
#pragma once

#include <memory>
#include <vector>

#include "flank/target.h"
#include "flank/triangle_mesh.h"

namespace flank {

/// A face as a surface: for distances with a sign (ObstacleField).
struct ObstacleFace {
  std::shared_ptr<const Target> surface;
  bool oriented = false;      ///< its normal points out of the material (the face of a solid)
  double clearance_mm = 0.0;  ///< >= 0: the flank keeps this far away; 0 for faces of the part
  /// Some of its solid is not asked for, so that nothing need stand before what only its material's side is seen of.
  bool bared = false;
};

/// Triangles, for the distances of a whole tool (PoseChecker).
struct ObstacleMesh {
  TriangleMesh mesh;      ///< open, overlapping or oriented in any way; points are triangles with three equal corners
  double slack_mm = 0.0;  ///< the true surface may come nearer than the mesh by this
  bool flank_may_touch = false;     ///< a target: only shank and holder keep clear of it
  double flank_clearance_mm = 0.0;  ///< >= 0: the flank keeps this far away
  double above_clearance_mm = 0.0;  ///< >= 0: shank and holder keep this far away
};

/// Faces of the part and of fixtures, in the forms that the planners measure. A value: copies share the surfaces.
struct Obstacles {
  /// Every face near the target: what the fit asks.
  std::vector<ObstacleFace> faces;
  /// The same faces as triangles, but for those of `solids`; for shank and holder these and the target as well.
  std::vector<ObstacleMesh> meshes;
  /// Closed solids that the target touches or runs into (a hub): by their exact signed distance, so that a tool that
  /// lies wholly within one is seen as well, and so are places of the target that are buried in one.
  std::vector<std::shared_ptr<const Target>> solids;

  [[nodiscard]] bool empty() const { return faces.empty() && meshes.empty() && solids.empty(); }
};

}  // namespace flank
