#include "flank/fit/lengthen.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "flank/tool.h"

namespace flank::internal {

RadialFunction lengthened(const RadialFunction& radial, double more_mm, double at_tip_mm) {
  constexpr int kSamplesPerCoefficient = 12;
  const double length = radial.axis_length(), longer = at_tip_mm + length + more_mm;
  const RadialJet tip = radial.at(0.0), end = radial.at(length);
  // Twice the coefficients: the old knots are not among the new ones.
  const int count = 2 * static_cast<int>(std::ceil(radial.parameter_count() * longer / length));
  const auto faded = [](double past, double all) { return past > 0.0 ? past - 0.5 * past * past / all : 0.0; };
  std::vector<Vec2> samples;
  for (int j = 0; j <= kSamplesPerCoefficient * count; ++j) {
    const double at = longer * j / (kSamplesPerCoefficient * count), s = at - at_tip_mm;
    const double kept = radial.at(std::clamp(s, 0.0, length)).r;
    samples.emplace_back(at, kept + end.d1 * faded(s - length, more_mm) - tip.d1 * faded(-s, at_tip_mm));
  }
  return RadialFunction::spline_through(longer, samples, count);
}

double lengthen_until_clear(FlankFitResult& fit, double step_mm,
                            const std::function<bool(const FlankFitResult&)>& clear) {
  if (fit.tool.family() != ToolFamily::kSpline || clear(fit)) return 0.0;
  for (const double more : {step_mm, 2.0 * step_mm, 4.0 * step_mm, 8.0 * step_mm}) {
    FlankFitResult longer = fit;
    longer.tool = lengthened(fit.tool, more);
    for (RuledMotion& motion : longer.motions) motion.axis_length += more;
    // A steep end bends back sharply on a short way.
    if (!check_legitimacy(longer.tool).legitimate || !clear(longer)) continue;
    fit = std::move(longer);
    return more;
  }
  return 0.0;
}

FitDraft run_on(const FitDraft& draft, double share) {
  constexpr int kPosesPerPoint = 8;
  FitDraft longer = draft;
  for (RuledMotion& motion : longer.motions) {
    const RuledMotion old = motion;
    const int points = old.tip.count(), count = kPosesPerPoint * points;
    std::vector<Pose> poses;
    std::vector<double> times;
    for (int i = 0; i <= count; ++i) {
      times.push_back(static_cast<double>(i) / count);
      poses.push_back(old.pose((1.0 + 2.0 * share) * times.back() - share));
    }
    motion = fit_motion(poses, times, old.axis_length, points);
  }
  return longer;
}

}  // namespace flank::internal
