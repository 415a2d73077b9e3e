#include "flank/verify/prove.h"

#include <algorithm>

#include "flank/verify/proof/depth_search.h"
#include "flank/verify/proof/face_shape.h"
#include "flank/verify/proof/mesh_shape.h"

namespace flank::internal::verify {

void prove_depth(const SweptVolume& volume, double least_radius_mm, const FaceShape& face, double tolerance_mm,
                 const ProofOptions& options, FaceVerdict& verdict) {
  const std::unique_ptr<Shape> shape = std::visit([](const auto* value) { return make_shape(*value); }, face);
  DepthLimits limits;
  limits.tolerance_mm = tolerance_mm;
  limits.gap_mm = options.gap_share * std::max(tolerance_mm, verdict.overcut_mm);
  limits.evaluations = options.evaluations;
  limits.cells = options.cells;
  const ProvedDepth proved = search_depth(volume, least_radius_mm, *shape, verdict.overcut_mm, limits);
  verdict.overcut_mm = proved.deepest_mm;
  verdict.overcut_bound_mm = proved.bound_mm;
  verdict.bound_point = proved.bound_mm > proved.deepest_mm ? proved.open_point : proved.point;
  verdict.proof_cells = proved.evaluations;
  if (proved.place.strip >= 0)
    verdict.deepest =
        WorstPlace{verdict.face, proved.point, proved.place.f, proved.place.strip, proved.place.t, proved.place.s};
}

}  // namespace flank::internal::verify
