#include "flank/pipeline/reduce_radius.h"

#include <algorithm>

#include "flank/base/tolerance_budget.h"

namespace flank::internal {

bool reduce_radius(double tolerance_mm, FitSearch& search, const VerifyReport& verify) {
  // Where a place beyond the tolerance was found, nobody looked how deep the others may be.
  const double found = std::max(verify.overcut_mm, verify.gouge_mm);
  const double deepest = found > tolerance_mm ? found : std::max(verify.overcut_bound_mm, verify.gouge_bound_mm);
  const bool near = deepest > tolerance_mm && deepest <= kToleranceBudget.fit.thinnable * tolerance_mm;
  if (!search.tool.free() || !near) return false;
  const Eigen::VectorXd radii =
      search.fit.tool.parameters().array() - (deepest - kToleranceBudget.fit.thinned * tolerance_mm);
  if (radii.minCoeff() < search.options.bounds.smallest) return false;
  search.fit.tool = search.fit.tool.with_parameters(radii);
  return true;
}

}  // namespace flank::internal
