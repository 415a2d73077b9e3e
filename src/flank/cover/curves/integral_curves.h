/// Integral curves of the admissible directions (paper B, section 4.2): where the axis would run if the tool touched to
/// second order all along it. Where such a curve is straight it is an axis.
///
/// The state is (footpoint, s); the axis point is c(s) = p + r(s) n. dc/ds is the admissible direction that continues
/// the last one, so d(c(s)) = r(s) all along, and r(s) = h is never solved for s: a radius that occurs twice needs no
/// memory of r', as in paper B.
#pragma once

#include <numbers>
#include <vector>

#include "flank/seed/direction/direction_filter.h"

namespace flank::internal {

/// Paper B's epsilon_linear, 2 degrees. It is published, not derived: what a turn costs is in straightness_of
/// (curves.cpp).
inline constexpr double kStraightnessRad = 2.0 * std::numbers::pi / 180.0;

struct IntegralCurveOptions {
  /// Steps of the midpoint rule over the whole axis, >= 2. Its error is of second order: on curvatures that change
  /// within a sixteenth of the axis, raise it; the time is proportional to it.
  int steps = 16;
  /// Largest angle between the direction at the seed and any other of the curve. That bounds the curve's distance to a
  /// line whatever the number of steps.
  double straightness_rad = kStraightnessRad;
  /// Paper B (13) as printed: the angle is that between the directions of two successive steps. Then the curve may turn
  /// by `steps` times as much.
  bool step_by_step = false;
  /// contact_length_mm > 0. A curve also goes on along directions that are only near a root (Candidate::kNear).
  DirectionFilterOptions filter;
};

/// Why a curve ended on one side.
enum class CurveEnd {
  kNotRun,
  kToolEnd,      ///< s = 0 or s = L
  kBorder,       ///< the footpoint leaves the trimmed target
  kFocal,        ///< r k2 > 1 by more than the filter allows: the sphere does not fit the hollow
  kLost,         ///< no admissible direction, nor one near enough
  kStraightness  ///< the direction turned by more than straightness_rad
};

/// A sphere of the tool at rest on the target, and one direction for the axis to go on.
struct CurveSeed {
  Footpoint foot;  ///< kInside
  double s = 0.0;
  Vec3 direction = Vec3::UnitZ();  ///< unit, tip to holder: one of candidate_directions(foot, r(s))
};

/// As many points as steps could be made, the seed's own among them. `tip` and `holder` say why it ended towards either
/// end.
struct IntegralCurve {
  std::vector<double> s;      ///< ascending, within [0, L]
  std::vector<Vec3> centres;  ///< c(s), mm
  CurveEnd tip = CurveEnd::kNotRun, holder = CurveEnd::kNotRun;
  /// Length of the piece of the axis that the curve runs along, mm.
  [[nodiscard]] double span() const { return s.empty() ? 0.0 : s.back() - s.front(); }
};

/// Footpoints spread evenly over the target (about `places`) times the middles of `spheres` equal pieces of [0, L],
/// with every direction that the filter leaves.
[[nodiscard]] std::vector<CurveSeed> curve_seeds(const Target& target, const RadialFunction& radial, int places,
                                                 int spheres, const DirectionFilterOptions& filter);

/// The curve through a seed, both ways. Error of the midpoint rule: of second order in L / steps.
[[nodiscard]] IntegralCurve integral_curve(const Target& target, const RadialFunction& radial, const CurveSeed& seed,
                                           const IntegralCurveOptions& options);

}  // namespace flank::internal
