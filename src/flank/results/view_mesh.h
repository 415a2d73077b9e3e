/// The faces of a part as triangles to look at.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "flank/part.h"
#include "flank/triangle_mesh.h"

namespace flank::internal {

struct ViewFace {
  std::string face;  ///< "F1"
  bool target = false;
  TriangleMesh mesh;
  std::vector<std::vector<Vec3>> borders;  ///< polylines
  /// Swept distance at the vertices, mm; empty for a check surface that the judge did not find entered.
  std::vector<double> f_mm;
  /// The same of a tool that bends, where that is asked for (pipeline/load/bending.h); else empty.
  std::vector<double> bent_mm;
  /// About how far the vertices stay from the tool's bodies, mm, negative inside: of fixtures, and of check surfaces that a
  /// shank or holder comes too near to; else empty (view_gaps.h).
  std::vector<double> gap_mm;
};

/// The targets get about kTargetTriangles triangles, the check surfaces that are entered kEnteredTriangles, all other
/// faces together at most about kOtherTriangles.
inline constexpr int kTargetTriangles = 60000;
inline constexpr int kEnteredTriangles = 40000;
inline constexpr int kOtherTriangles = 150000;
/// A mesh of more triangles than this is drawn coarser.
inline constexpr int kMostMeshTriangles = 300000;
/// Every face of the part: `targets` (indices) finely, those named in `entered` nearly so, the others as coarsely as they
/// may look.
[[nodiscard]] std::vector<ViewFace> view_faces(const Part& part, const std::vector<int>& targets,
                                               const std::set<std::string>& entered);

/// Every face of a fixture, in about this many triangles, or as many as a mesh has: fine enough to show where it is entered.
inline constexpr int kFixtureTriangles = 25000;
[[nodiscard]] std::vector<ViewFace> view_fixture(const Part& fixture);

}  // namespace flank::internal
