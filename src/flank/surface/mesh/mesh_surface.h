/// The smooth surface of a mesh: the jets of each triangle's corners, blended.
#pragma once

#include <array>
#include <vector>

#include "flank/bspline_surface.h"
#include "flank/geom/mesh_topology.h"
#include "flank/surface/mesh/jet.h"

namespace flank::internal {

/// A blending weight and its derivatives by u and v.
struct BlendWeight {
  double w, u, v, uu, uv, vv;
};

/// Over a triangle with corners v0, v1, v2, at barycentric weights (1 - u - v, u, v):
///   S(u, v) = sum_i w_i F_i(x),  x = (1 - u - v) v0 + u v1 + v v2,  w_i = b_i^3 / (b_0^3 + b_1^3 + b_2^3),
/// where F_i moves x along the normal of corner i onto its jet. The weight of the opposite corner vanishes with its
/// first and second derivatives on a side, so only the two jets of its ends meet there, from both triangles: position
/// and, up to what these jets differ, tangent plane and curvature are continuous.
struct JetSurface {
  TriangleMesh mesh;      ///< first the real triangles, then those of the extension
  MeshTopology topology;  ///< of all of them
  std::vector<Jet> jets;  ///< one a vertex
  int real_triangles = 0;

  /// Point and derivatives by (u, v) up to second order; usable a little outside the triangle.
  [[nodiscard]] SurfaceJet jet(int triangle, double u, double v) const;
  /// Area of the blended surface over a triangle, in mm^2, by a quadrature that is exact for fifth degree.
  [[nodiscard]] double area(int triangle) const;
  [[nodiscard]] const Vec3& corner(int triangle, int k) const {
    return mesh.vertices[static_cast<std::size_t>(mesh.triangles[static_cast<std::size_t>(triangle)][k])];
  }
  [[nodiscard]] int neighbor(int triangle, int side) const {
    return topology.neighbors[static_cast<std::size_t>(triangle)][side];
  }

 private:
  [[nodiscard]] SurfaceJet blended(int triangle, double u, double v, const std::array<BlendWeight, 3>& blend) const;
};

}  // namespace flank::internal
