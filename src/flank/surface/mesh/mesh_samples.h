/// Samples of a mesh.
#pragma once

#include <vector>

#include "flank/surface/mesh/mesh_surface.h"
#include "flank/target.h"

namespace flank::internal {

/// Where samples lie: on the blended surface, or on the triangles under it, as a judge sees the part. Both have its normals.
enum class SamplePlaces { kBlended, kFacets };

/// Triangles larger than a cell of the spacing are divided evenly into similar ones; smaller neighbours are put
/// together into patches of about spacing_mm^2 whose normals keep within 60 degrees of each other, each with one sample
/// near its centre. The areas add up to that of the surface.
[[nodiscard]] std::vector<SurfaceSample> mesh_samples(const JetSurface& surface, double spacing_mm,
                                                      SamplePlaces places);

/// Points along the open sides of the first `triangles` of a mesh, at most `spacing_mm` > 0 apart; a side to a triangle behind these is
/// open.
[[nodiscard]] std::vector<Vec3> open_side_points(const TriangleMesh& mesh, const MeshTopology& topology, int triangles,
                                                 double spacing_mm);

}  // namespace flank::internal
