#include "flank/surface/facet_gaps.h"

#include <algorithm>
#include <cmath>

#include "flank/surface/mesh/mesh_samples.h"
#include "flank/surface/mesh/mesh_target.h"

namespace flank::internal {

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
    const double gap = (smooth[k].point - flat[k].point).norm();
    gaps.largest_mm = std::max(gaps.largest_mm, gap);
    area += flat[k].area;
    if (gap > beyond_mm) gaps.share += flat[k].area;
  }
  if (area > 0.0) gaps.share /= area;
  return gaps;
}

double most_of_facets(const Target& target, double tolerance_mm) {
  return 1.0 - facet_gaps(target, 2.0 * tolerance_mm).share;
}

}  // namespace flank::internal
