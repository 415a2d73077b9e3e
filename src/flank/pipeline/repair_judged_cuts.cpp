#include "flank/pipeline/repair_judged_cuts.h"

#include <utility>

#include "flank/pipeline/reduce_radius.h"
#include "flank/pipeline/refit_at_cuts.h"

namespace flank::internal {

bool repair_judged_cuts(double tolerance_mm, std::optional<JudgedFit>& before, FitSearch& search,
                        const VerifyReport& verify) {
  if (!before) {
    before = JudgedFit{search.fit, verify};
    return refit_at_cuts(tolerance_mm, search, verify) || reduce_radius(tolerance_mm, search, verify);
  }
  // A motion that was led out of the target and into another face is given up.
  if (verify.gouge_mm > tolerance_mm && before->verify.gouge_mm <= tolerance_mm) {
    std::swap(search.fit, before->fit);
    if (reduce_radius(tolerance_mm, search, before->verify)) return true;
    std::swap(search.fit, before->fit);
  }
  return reduce_radius(tolerance_mm, search, verify) || refit_at_cuts(tolerance_mm, search, verify);
}

}  // namespace flank::internal
