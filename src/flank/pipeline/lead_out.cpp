#include "flank/pipeline/lead_out.h"

#include <utility>

#include "flank/pipeline/mend_cuts.h"
#include "flank/pipeline/thin_tool.h"

namespace flank::internal {

bool lead_out(double tolerance_mm, std::optional<JudgedFit>& before, FitSearch& search, const VerifyReport& verify) {
  if (!before) {
    before = JudgedFit{search.fit, verify};
    return mend_cuts(tolerance_mm, search, verify) || thin_tool(tolerance_mm, search, verify);
  }
  // A motion that was led out of the target and into another face is given up.
  if (verify.gouge_mm > tolerance_mm && before->verify.gouge_mm <= tolerance_mm) {
    std::swap(search.fit, before->fit);
    if (thin_tool(tolerance_mm, search, before->verify)) return true;
    std::swap(search.fit, before->fit);
  }
  return thin_tool(tolerance_mm, search, verify) || mend_cuts(tolerance_mm, search, verify);
}

}  // namespace flank::internal
