#include "flank/fit/model/minimise.h"

#include <algorithm>
#include <cmath>

#include "flank/fit/model/levenberg_marquardt.h"

namespace flank::internal {

ResidualSummary summarise_residuals(const FitModel& model, const FitState& state) {
  ResidualSummary summary;
  std::size_t inside = 0, all = 0;
  double squares = 0.0;
  const int n = model.samples_s();
  std::vector<double> radius(n);
  const double length = state.motions.front().axis_length;
  for (int j = 0; j < n; ++j) radius[j] = state.tool.at(length * j / (n - 1)).r;
  for (const std::vector<Footpoint>& feet : state.feet) {
    for (std::size_t k = 0; k < feet.size(); ++k) {
      ++all;
      // Past the border a residual is against an extrapolated surface: no error of the part.
      if (feet[k].location != Location::kInside) continue;
      ++inside;
      const double e = feet[k].distance - radius[k % n];
      squares += e * e;
      summary.largest_mm = std::max(summary.largest_mm, std::abs(e));
      summary.largest_overcut_mm = std::max(summary.largest_overcut_mm, -e);
    }
  }
  if (inside > 0) summary.rms_mm = std::sqrt(squares / static_cast<double>(inside));
  if (all > 0) summary.inside_share = static_cast<double>(inside) / static_cast<double>(all);
  return summary;
}

MinimiseResult minimise(const FitModel& model, FitState start) { return levenberg_marquardt(model, std::move(start)); }

}  // namespace flank::internal
