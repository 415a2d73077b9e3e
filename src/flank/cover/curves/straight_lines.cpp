#include "flank/cover/curves/straight_lines.h"

#include "flank/base/assert.h"

namespace flank::internal {

// Each point knows its s, so corresponding points are fitted, not a line to a cloud: minimise sum |a + s_k u - c_k|^2
// over a and unit u. With the means taken off only -2 <u, sum s c> depends on u: u is along that sum. No eigenvalue
// problem, and the result is a pose.
Pose line_through(const IntegralCurve& curve) {
  FLANK_ASSERT(curve.s.size() >= 2 && curve.centres.size() == curve.s.size());
  const auto count = static_cast<double>(curve.s.size());
  double mean_s = 0.0;
  Vec3 mean = Vec3::Zero(), sum = Vec3::Zero();
  for (std::size_t k = 0; k < curve.s.size(); ++k) {
    mean_s += curve.s[k] / count;
    mean += curve.centres[k] / count;
  }
  for (std::size_t k = 0; k < curve.s.size(); ++k) sum += (curve.s[k] - mean_s) * (curve.centres[k] - mean);
  const Vec3 axis = sum.normalized();
  return {mean - mean_s * axis, axis};
}

std::optional<StraightLine> straight_line(const IntegralCurve& curve, LineFitter& fitter, const PoseGuard& guard,
                                          const StraightLineOptions& options) {
  const double length = fitter.axis_length();
  if (curve.s.size() < 2 || curve.span() < options.least_span * length) return std::nullopt;
  fitter.forget();
  const auto fitted = [&](const Pose& pose) { return options.refine ? fitter.refine(pose) : fitter.measure(pose); };
  // The curves come in no order of place: hints of the last line would lead astray, hence the forget() above.
  LineFit line = fitted(line_through(curve));
  if (!guard.clear(line.pose)) line = fitted(slid_clear(guard, line.pose, length));
  if (!line.touches() || line.inside_share < options.least_inside || line.largest_mm > options.most_error_mm ||
      fitter.overcut(line.pose) > options.most_error_mm || !guard.clear(line.pose))
    return std::nullopt;
  const Movability form = movability(fitter.feet(), line.pose, length);
  if (!form.valid()) return std::nullopt;
  return StraightLine{line.pose, line.largest_mm, form.value, form.velocity};
}

}  // namespace flank::internal
