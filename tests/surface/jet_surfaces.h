/// Blended surfaces of test meshes, without extension.
#pragma once

#include "flank/geom/mesh_repair.h"
#include "flank/surface/mesh/jet_field.h"
#include "flank/surface/mesh/mesh_surface.h"
#include "surface/mesh_shapes.h"

namespace flank::internal::shapes {

inline JetSurface jet_surface(TriangleMesh mesh) {
  JetSurface s;
  s.mesh = repair_mesh(std::move(mesh)).mesh;
  s.topology = link_triangles(s.mesh, 0.9);
  s.real_triangles = static_cast<int>(s.mesh.triangles.size());
  for (const JetFit& fit : fit_jets(s.mesh, s.topology, vertex_normals(s.mesh))) s.jets.push_back(fit.jet);
  return s;
}

/// The rectangle [0, x] x [0, y] in the plane z = 0, normal +z.
inline TriangleMesh sheet(double x, double y, int nx, int ny) {
  return grid(nx, ny, [=](double u, double v) { return Vec3(x * u, y * v, 0.0); });
}

}  // namespace flank::internal::shapes
