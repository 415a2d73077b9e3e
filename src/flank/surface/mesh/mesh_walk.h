/// Footpoints on the blended jets of a mesh, by Newton steps that walk from triangle to triangle.
#pragma once

#include "flank/surface/mesh/mesh_surface.h"
#include "flank/target.h"

namespace flank::internal {

/// A place on a JetSurface: barycentric weights (1 - u - v, u, v) in a triangle.
struct MeshPlace {
  int triangle = -1;
  double u = 0.0, v = 0.0;
};

/// Where a walk may go.
enum class Reach { kReal, kExtended };

struct MeshWalk {
  MeshPlace place;
  SurfaceJet jet;          ///< there
  bool on_border = false;  ///< held by an open side: p - point is not along the normal
  bool converged = false;  ///< a local minimum was reached, free or held
};

/// Descends to a local minimum of |S - p| from `start`.
[[nodiscard]] MeshWalk walk_to_footpoint(const JetSurface& surface, const Vec3& p, MeshPlace start, Reach reach);

/// Distance, normal and principal curvatures at the end of a walk.
[[nodiscard]] Footpoint footpoint_of(const MeshWalk& walk, const Vec3& p, int real_triangles);

}  // namespace flank::internal
