#include "flank/verify/swept/segment_minimum.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/assert.h"

namespace flank::internal::verify {
namespace {

constexpr double kGainMm = 1e-13;  ///< predicted decrease at which a minimum counts as reached
/// Predicted decrease that round-off may hide: if no step goes down, what was left to gain must be below this.
constexpr double kHiddenGainMm = 1e-11;
/// Of the product of the diagonal: a Hessian with less determinant is not trusted to be convex.
constexpr double kLeastDeterminant = 1e-6;
/// Of the smallest radius: a point nearer to the axis than this has no direction to it that could be trusted.
constexpr double kLeastDistance = 1e-3, kLeastRadiusMm = 1e-6;
/// Newton's steps (it converges in a few) and halvings of each, before the slow search takes over.
constexpr int kMostSteps = 24, kMostHalvings = 20;
/// Of the interval: where golden section stops. f is flat at its minimum, so its error is the square of that.
constexpr double kNarrowed = 1e-6;

struct Step {
  double tau = 0.0, s = 0.0;
  double gain = 0.0;  ///< predicted decrease
  bool convex = true;
};

/// Newton's step with the coordinates that press against their bounds held.
Step newton_step(const DistanceJet& j, bool hold_tau, bool hold_s) {
  Step step;
  if (hold_tau && hold_s) return step;
  if (hold_tau) {
    step.convex = j.dss > 0.0;
    if (step.convex) step.s = -j.ds / j.dss, step.gain = 0.5 * j.ds * j.ds / j.dss;
    return step;
  }
  if (hold_s) {
    step.convex = j.dtt > 0.0;
    if (step.convex) step.tau = -j.dt / j.dtt, step.gain = 0.5 * j.dt * j.dt / j.dtt;
    return step;
  }
  const double determinant = j.dtt * j.dss - j.dts * j.dts;
  step.convex = j.dss > 0.0 && determinant > kLeastDeterminant * j.dtt * j.dss;
  if (!step.convex) return step;
  step.tau = -(j.dss * j.dt - j.dts * j.ds) / determinant;
  step.s = -(j.dtt * j.ds - j.dts * j.dt) / determinant;
  step.gain = -0.5 * (step.tau * j.dt + step.s * j.ds);
  return step;
}

}  // namespace

bool descend(const Segment& segment, const RadialTable& radial, const Vec3& x, double low, double high,
             SegmentMinimum& best) {
  FLANK_ASSERT(low <= best.tau && best.tau <= high);
  const double length = radial.length();
  const double least_distance = kLeastDistance * std::max(kLeastRadiusMm, radial.least_radius());
  DistanceJet j = distance_jet(segment, radial, x, best.tau, best.s);
  best.f = j.f;
  for (int iteration = 0; iteration < kMostSteps; ++iteration) {
    if (!(j.distance > least_distance)) return false;
    const bool hold_tau = (best.tau <= low && j.dt >= 0.0) || (best.tau >= high && j.dt <= 0.0);
    const bool hold_s = (best.s <= 0.0 && j.ds >= 0.0) || (best.s >= length && j.ds <= 0.0);
    Step step = newton_step(j, hold_tau, hold_s);
    // A coordinate at its bound that the coupled step would push out is held after all.
    const auto leaves = [](double at, double by, double first, double last) {
      return (at <= first && by < 0.0) || (at >= last && by > 0.0);
    };
    if (step.convex && !hold_tau && !hold_s) {
      if (leaves(best.tau, step.tau, low, high)) {
        step = newton_step(j, true, false);
      } else if (leaves(best.s, step.s, 0.0, length)) {
        step = newton_step(j, false, true);
      }
    }
    if (!step.convex) return false;
    if (step.gain < kGainMm) return true;
    double fraction = 1.0;
    bool lower = false;
    for (int halving = 0; halving < kMostHalvings && !lower; ++halving, fraction *= 0.5) {
      const double tau = std::clamp(best.tau + fraction * step.tau, low, high);
      const double s = std::clamp(best.s + fraction * step.s, 0.0, length);
      const DistanceJet next = distance_jet(segment, radial, x, tau, s);
      if (next.f < best.f) {
        best = {next.f, tau, s};
        j = next;
        lower = true;
      }
    }
    if (!lower) return step.gain < kHiddenGainMm;
  }
  return false;
}

SegmentMinimum bracketed_minimum(const Segment& segment, const ToolDistance& tool, const Vec3& x, double low,
                                 double high) {
  FLANK_ASSERT(low <= high);
  constexpr int kPieces =
      8;  // first cut: a piece moves the axis by a tenth of a radius, so more minima would be strange
  constexpr double kGolden = 0.6180339887498949;
  const auto evaluate = [&](double tau) {
    const Pose pose = segment.at(tau);
    const PlanePoint p = plane_point(pose.tip, pose.axis, x);
    const NearestSphere near = tool.nearest(p.z, p.rho);
    return SegmentMinimum{near.g, tau, near.s};
  };
  std::array<SegmentMinimum, kPieces + 1> at;
  SegmentMinimum best;
  for (int i = 0; i <= kPieces; ++i) {
    at[i] = evaluate(low + (high - low) * i / kPieces);
    if (at[i].f < best.f) best = at[i];
  }
  if (!(high > low)) return best;
  for (int i = 0; i <= kPieces; ++i) {
    if ((i > 0 && at[i - 1].f < at[i].f) || (i < kPieces && at[i + 1].f < at[i].f)) continue;
    double a = at[std::max(0, i - 1)].tau, b = at[std::min(kPieces, i + 1)].tau;
    SegmentMinimum c = evaluate(b - kGolden * (b - a)), d = evaluate(a + kGolden * (b - a));
    while (b - a > kNarrowed * (high - low)) {
      if (c.f < d.f) {
        b = d.tau, d = c, c = evaluate(b - kGolden * (b - a));
      } else {
        a = c.tau, c = d, d = evaluate(a + kGolden * (b - a));
      }
    }
    SegmentMinimum found = c.f < d.f ? c : d;
    if (at[i].f < found.f) found = at[i];
    SegmentMinimum polished = found;
    (void)descend(segment, tool.radial(), x, low, high, polished);
    if (polished.f < found.f) found = polished;
    if (found.f < best.f) best = found;
  }
  return best;
}

}  // namespace flank::internal::verify
