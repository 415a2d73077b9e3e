#include "flank/cover/certify.h"

#include <algorithm>

namespace flank {

bool is_certified(const LineGuard& guard, const CoverStrip& strip, double tolerance_mm) {
  if (strip.cells.empty() || strip.overcut_mm > kCertifiedShare * tolerance_mm) return false;
  const int poses = depth_poses(strip.motion);
  for (int i = 0; i <= poses; ++i)
    if (!guard.clear(strip.motion.pose(static_cast<double>(i) / poses))) return false;
  return true;
}

CoverStrip cut_to_certified(const CoverSamples& samples, const LineGuard& guard, CoverStrip strip,
                            const RadialFunction& radial, LineFitter& fitter) {
  constexpr int kTries = 3;
  constexpr double kShortest = 0.1;
  const double tolerance = fitter.options().tolerance_mm;
  for (int k = 0; k < kTries && !strip.cells.empty() && !is_certified(guard, strip, tolerance); ++k) {
    const int poses = depth_poses(strip.motion);
    const std::vector<double> depths = depths_along(samples, strip.motion, radial, fitter);
    int first = 0, longest = 0;
    for (int i = 0, run = 0; i <= poses; ++i) {
      const bool good = depths[static_cast<std::size_t>(i)] <= kCertifiedShare * tolerance &&
                        guard.clear(strip.motion.pose(static_cast<double>(i) / poses));
      run = good ? run + 1 : 0;
      if (run <= longest) continue;
      longest = run;
      first = i - run + 1;
    }
    // The new ends lie a step within: right at the edge of what is allowed the next step may be beyond it.
    const double t0 = (first + (first > 0 ? 1.0 : 0.0)) / poses;
    const double t1 = (first + longest - (first + longest <= poses ? 2.0 : 1.0)) / poses;
    if (t1 - t0 < kShortest) return {};
    strip = measure_strip(samples, part_of_motion(strip.motion, t0, t1), radial, fitter);
  }
  return is_certified(guard, strip, tolerance) ? strip : CoverStrip{};
}

}  // namespace flank
