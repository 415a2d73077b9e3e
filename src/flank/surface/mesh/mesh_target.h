/// The target of a triangle mesh. Made by make_target of target.h; the class is here for tests and for those that need
/// its surface.
#pragma once

#include "flank/geom/triangle_bvh.h"
#include "flank/surface/mesh/mesh_quality.h"
#include "flank/surface/mesh/mesh_surface.h"
#include "flank/surface/mesh/mesh_walk.h"
#include "flank/target.h"

namespace flank::internal {

/// The mesh is repaired (mesh_repair.h), cut at its creases and given jets; where its noise (mesh_quality.h) asks for
/// it, the jets are fitted to as many neighbours as the noise allows. Footpoint::patch is the triangle in the repaired
/// mesh (the mesh itself, if it was sound), or, from its triangle count on, one of the extension; u and v are the
/// weights of its second and third corner.
class MeshTarget final : public Target {
 public:
  /// Throws InputError for a mesh that repair_mesh refuses.
  MeshTarget(TriangleMesh mesh, const ExtensionOptions& options);

  [[nodiscard]] Footpoint closest_within(const Vec3& p, double horizon_mm) const override;
  [[nodiscard]] Footpoint track(const Vec3& p, const Footpoint& hint) const override;
  [[nodiscard]] std::vector<SurfaceSample> samples(double spacing_mm) const override;
  [[nodiscard]] SurfaceSample as_given(const SurfaceSample& sample) const override;
  [[nodiscard]] bool is_nearer(const Vec3& p, double mm) const override;
  [[nodiscard]] double samples_off_mm() const override { return flat_error_; }
  [[nodiscard]] std::vector<Vec3> border_points(double spacing_mm) const override;
  [[nodiscard]] int patch_count() const override { return surface_.real_triangles; }

  /// The smooth surface that footpoints lie on, and what was found out about the noise of the mesh.
  [[nodiscard]] const JetSurface& surface() const { return surface_; }
  [[nodiscard]] const MeshQuality& quality() const { return quality_; }

 private:
  /// The cold query: candidates of the tree within flat_error_, each refined by a walk on the smooth surface.
  [[nodiscard]] MeshWalk closest_walk(const Vec3& p) const;
  /// Box, area and flat_error_.
  void measure();

  JetSurface surface_;
  /// Over the flat triangles, without the extension.
  TriangleBvh tree_;
  MeshQuality quality_;
  double flat_error_ = 0.0;  // largest distance seen between a flat triangle and the blended surface
};

}  // namespace flank::internal
