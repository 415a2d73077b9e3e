#include "flank/pipeline/refit_at_cuts.h"

#include <algorithm>

#include "flank/fit/polish.h"

namespace flank::internal {
namespace {

/// The place of the targets nearest to a point.
Vec3 nearest_target(const FitSearch& search, const Vec3& point) {
  Footpoint nearest;
  double least = 1e300;
  for (const TargetGroup& group : search.machined()) {
    const Footpoint foot = group.target->closest(point);
    if (foot.patch < 0 || (foot.point - point).norm() >= least) continue;
    nearest = foot;
    least = (foot.point - point).norm();
  }
  return nearest.point;
}

}  // namespace

bool refit_at_cuts(double tolerance_mm, FitSearch& search, const VerifyReport& verify) {
  constexpr double kDenser = 3.0;  // in each direction: a ridge shows one place to the judge, and many to the samples
  if (search.fit.motions.empty() || verify.overcut_mm > kMendable * tolerance_mm) return false;
  FlankFitOptions options = search.options;
  options.sample_share /= kDenser;
  // Where the wanted surface is, which the judge's places lie below by what is left on purpose.
  const auto add = [&](const Vec3& place) {
    options.extra_overcut_points.push_back(verify.allowance_mm > 0.0 ? nearest_target(search, place) : place);
  };
  for (const FaceVerdict& face : verify.faces)
    if (face.target && face.deepest) add(face.deepest->point);
  for (const WorstPlace& place : verify.worst) {
    const bool target = std::any_of(verify.faces.begin(), verify.faces.end(),
                                    [&](const FaceVerdict& f) { return f.target && f.face == place.face; });
    if (target && place.f < -tolerance_mm) add(place.point);
  }
  if (!(verify.overcut_mm > tolerance_mm) || options.extra_overcut_points.empty()) return false;
  std::optional<FlankFitResult> mended = mend_fit(search.tasks(), search.fit, search.tool, options);
  if (!mended) return false;
  search.fit = std::move(*mended);
  return true;
}

}  // namespace flank::internal
