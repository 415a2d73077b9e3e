#include "flank/cover/curves/integral_curves.h"

#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"
#include "flank/seed/direction/seeds.h"

namespace flank::internal {
namespace {

/// Of the axis length: a rest of the axis that is shorter than this is round-off, not a step.
constexpr double kShortestStep = 1e-9;

/// One side of a curve, from the seed towards the tip or the holder.
class Tracer {
 public:
  Tracer(const Target& target, const RadialFunction& radial, const IntegralCurveOptions& options)
      : target_(target), radial_(radial), options_(options) {}

  /// Appends the points after the seed's own, which is not among them.
  CurveEnd run(const CurveSeed& seed, bool to_holder, std::vector<double>& s, std::vector<Vec3>& centres);

 private:
  struct State {
    Footpoint foot;
    double s = 0.0;
    Vec3 direction;
  };
  [[nodiscard]] CurveEnd moved(const State& from, const Vec3& slope, double step, State& to) const;
  [[nodiscard]] CurveEnd continued(const Footpoint& foot, const RadialJet& jet, Vec3& direction) const;

  const Target& target_;
  const RadialFunction& radial_;
  const IntegralCurveOptions& options_;
};

/// The admissible direction nearest to the last one. At an umbilic of the right curvature all are admissible: the last
/// one goes on, laid into the cone of first-order contact.
CurveEnd Tracer::continued(const Footpoint& foot, const RadialJet& jet, Vec3& direction) const {
  const CandidateDirections found = candidate_directions(foot, jet, options_.filter);
  if (found.candidate == Candidate::kRejected) return foot.k2 * jet.r > 1.0 ? CurveEnd::kFocal : CurveEnd::kLost;
  if (found.every) {
    const Vec3 across = direction - direction.dot(foot.normal) * foot.normal;
    direction = jet.d1 * foot.normal + std::sqrt(1.0 - jet.d1 * jet.d1) * across.normalized();
    return CurveEnd::kNotRun;
  }
  const auto all = found.all();
  direction = *std::max_element(all.begin(), all.end(),
                                [&](const Vec3& a, const Vec3& b) { return a.dot(direction) < b.dot(direction); });
  return CurveEnd::kNotRun;
}

/// Goes along `slope` by `step` of s and back onto d = r(s); the direction there continues that of `from`.
CurveEnd Tracer::moved(const State& from, const Vec3& slope, double step, State& to) const {
  const Vec3 centre = from.foot.point + radial_.at(from.s).r * from.foot.normal;
  to.s = from.s + step;
  to.foot = target_.track(centre + step * slope, from.foot);
  if (to.foot.location != Location::kInside) return CurveEnd::kBorder;
  to.direction = from.direction;
  return continued(to.foot, radial_.at(to.s), to.direction);
}

CurveEnd Tracer::run(const CurveSeed& seed, bool to_holder, std::vector<double>& s, std::vector<Vec3>& centres) {
  const double length = radial_.axis_length(), end = to_holder ? length : 0.0;
  const double most = std::cos(options_.straightness_rad), shortest = kShortestStep * length;
  State now{seed.foot, seed.s, seed.direction}, middle, next;
  while (std::abs(end - now.s) > shortest) {
    const double reach = std::min(length / options_.steps, std::abs(end - now.s));
    const double step = to_holder ? reach : -reach;
    // Midpoint rule: half a step to learn the direction there, then the whole step along it.
    if (const CurveEnd why = moved(now, now.direction, 0.5 * step, middle); why != CurveEnd::kNotRun) return why;
    if (const CurveEnd why = moved(now, middle.direction, step, next); why != CurveEnd::kNotRun) return why;
    // Counted from the seed, the turn bounds how far the curve is from a line whatever the number of steps.
    const Vec3& reference = options_.step_by_step ? now.direction : seed.direction;
    if (next.direction.dot(reference) < most) return CurveEnd::kStraightness;
    now = next;
    s.push_back(now.s);
    centres.push_back(now.foot.point + radial_.at(now.s).r * now.foot.normal);
  }
  return CurveEnd::kToolEnd;
}

}  // namespace

std::vector<CurveSeed> curve_seeds(const Target& target, const RadialFunction& radial, int places, int spheres,
                                   const DirectionFilterOptions& filter) {
  std::vector<CurveSeed> seeds;
  for (const SurfaceSample& sample : grid_places(target, places)) {
    const Footpoint foot = target.closest(sample.point);
    if (foot.location != Location::kInside) continue;
    for (int j = 0; j < spheres; ++j) {
      const double s = (j + 0.5) / spheres * radial.axis_length();
      const CandidateDirections found = candidate_directions(foot, radial.at(s), filter);
      for (const Vec3& direction : found.all()) seeds.push_back({foot, s, direction});
    }
  }
  return seeds;
}

IntegralCurve integral_curve(const Target& target, const RadialFunction& radial, const CurveSeed& seed,
                             const IntegralCurveOptions& options) {
  FLANK_ASSERT(options.steps >= 2 && std::abs(seed.direction.squaredNorm() - 1.0) < 1e-6);
  IntegralCurve curve;
  Tracer tracer(target, radial, options);
  const std::size_t most = static_cast<std::size_t>(options.steps) + 3;  // a shorter last step each way, and the seed
  curve.s.reserve(most);
  curve.centres.reserve(most);
  curve.tip = tracer.run(seed, false, curve.s, curve.centres);
  std::reverse(curve.s.begin(), curve.s.end());
  std::reverse(curve.centres.begin(), curve.centres.end());
  curve.s.push_back(seed.s);
  curve.centres.push_back(seed.foot.point + radial.at(seed.s).r * seed.foot.normal);
  curve.holder = tracer.run(seed, true, curve.s, curve.centres);
  return curve;
}

}  // namespace flank::internal
