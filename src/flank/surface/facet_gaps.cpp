#include "flank/surface/facet_gaps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flank/surface/mesh/mesh_samples.h"
#include "flank/surface/mesh/mesh_target.h"

namespace flank::internal {
namespace {

/// Twice the area, along the normal.
Vec3 area_vector(const JetSurface& surface, int triangle) {
  const Vec3& a = surface.corner(triangle, 0);
  return (surface.corner(triangle, 1) - a).cross(surface.corner(triangle, 2) - a);
}

/// The most that a smooth surface through the corners stands off a triangle by the folds at its sides, mm, four times what evenly bent
/// cells have. The blended surface may stand off farther beside slivers, whose corners have normals of chance. Folds
/// to neighbours that are slivers themselves say nothing. Infinite for a triangle without neighbours.
double most_by_folds(const JetSurface& surface, int triangle) {
  constexpr double kOfFold = 0.5, kSliver = 4.0;
  const Vec3 own = area_vector(surface, triangle);
  double most = -1.0;
  for (int k = 0; k < 3; ++k) {
    const int next = surface.neighbor(triangle, k);
    if (next < 0 || next >= surface.real_triangles) continue;
    const Vec3 other = area_vector(surface, next);
    const double fold = std::atan2(own.cross(other).norm(), own.dot(other));
    const double side = (surface.corner(triangle, (k + 2) % 3) - surface.corner(triangle, (k + 1) % 3)).norm();
    most = std::max(most, kOfFold * fold * std::min(own.norm(), kSliver * other.norm()) / side);
  }
  return most < 0.0 ? std::numeric_limits<double>::infinity() : most;
}

}  // namespace

FacetGaps facet_gaps(const Target& target, double beyond_mm) {
  constexpr double kPlaces = 4000.0;  // shares are then good to a thousandth
  FacetGaps gaps;
  const auto* mesh = dynamic_cast<const MeshTarget*>(&target);
  if (mesh == nullptr) return gaps;
  const double spacing = std::sqrt(target.area() / kPlaces);
  const std::vector<SurfaceSample> smooth = mesh_samples(mesh->surface(), spacing, SamplePlaces::kBlended),
                                   flat = mesh_samples(mesh->surface(), spacing, SamplePlaces::kFacets);
  double area = 0.0;
  for (std::size_t k = 0; k < flat.size(); ++k) {
    const double gap =
        std::min((smooth[k].point - flat[k].point).norm(), most_by_folds(mesh->surface(), flat[k].patch));
    gaps.largest_mm = std::max(gaps.largest_mm, gap);
    area += flat[k].area;
    if (gap > beyond_mm) gaps.share += flat[k].area;
  }
  if (area > 0.0) gaps.share /= area;
  return gaps;
}

double coverage_bound_by_facets(const Target& target, double tolerance_mm) {
  return 1.0 - facet_gaps(target, 2.0 * tolerance_mm).share;
}

}  // namespace flank::internal
