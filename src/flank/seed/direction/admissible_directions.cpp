#include "flank/seed/direction/admissible_directions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Written so that NaN is refused as well: every comparison with it is false.
bool is_a_tool(const Footpoint& foot, const RadialJet& radial) {
  return radial.r > 0.0 && std::abs(radial.d1) < 1.0 && std::isfinite(radial.r) && std::isfinite(radial.d2) &&
         std::isfinite(foot.k1) && std::isfinite(foot.k2);
}

void add_roots(const Footpoint& foot, const RadialJet& radial, std::initializer_list<double> angles,
               AdmissibleDirections& out) {
  for (const double theta : angles)
    out.directions[static_cast<std::size_t>(out.count++)] = axis_direction(foot, radial, theta);
}

/// The sphere touches all along its circle across d1: only along d1 is there anything left to ask.
void at_focal_point(const Footpoint& foot, const RadialJet& radial, AdmissibleDirections& out) {
  const double clear = 1.0 - radial.r * foot.k1;
  out.status = DirectionStatus::kFocal;
  out.lambda1 = clear > kFocalBand ? -foot.k1 / clear : -kInfinity;
  out.lambda2 = -kInfinity;
  out.gap = std::abs(out.mu - out.lambda1);
}

/// lambda1 = lambda2: mu fits all directions or none. The test is relative to 1/r, the scale of every curvature that
/// matters.
void at_umbilic(AdmissibleDirections& out, double r) {
  const bool fits = r * out.gap <= kUmbilicSpread;
  out.status = fits ? DirectionStatus::kEvery : DirectionStatus::kNone;
}

/// across, along: sin^2 and cos^2 times (k2 - k1); their sum is k2 - k1 whether the root is real or not.
void at_ordinary_point(const Footpoint& foot, const RadialJet& radial, AdmissibleDirections& out) {
  const double clear1 = 1.0 - radial.r * foot.k1, clear2 = 1.0 - radial.r * foot.k2;
  const double along = clear1 * (out.mu * clear2 + foot.k2), across = -clear2 * (out.mu * clear1 + foot.k1);
  const double margin = kMergedRoots * (foot.k2 - foot.k1), half_turn = std::numbers::pi;
  if (std::min(along, across) > margin) {
    out.status = DirectionStatus::kFour;
    // From both squares: acos of one alone would lose half the digits beside its end of [0, pi/2].
    out.theta = std::atan2(std::sqrt(across), std::sqrt(along));
    add_roots(foot, radial, {out.theta, -out.theta, half_turn - out.theta, half_turn + out.theta}, out);
    return;
  }
  // Merged or missing root: the principal direction on whose side it lies.
  out.theta = along > across ? 0.0 : 0.5 * half_turn;
  out.status = std::min(along, across) < -margin ? DirectionStatus::kNone : DirectionStatus::kTwo;
  if (out.status == DirectionStatus::kTwo) add_roots(foot, radial, {out.theta, half_turn + out.theta}, out);
}

}  // namespace

AdmissibleDirections admissible_directions(const Footpoint& foot, const RadialJet& radial) {
  AdmissibleDirections out;
  out.gap = kInfinity;
  if (!is_a_tool(foot, radial)) return out;
  out.centre = foot.point + radial.r * foot.normal;
  out.mu = radial.d2 / (1.0 - radial.d1 * radial.d1);
  // Focal points before anything is divided by 1 - r k2.
  const double focal = radial.r * foot.k2 - 1.0;
  if (focal > kFocalBand) {
    out.status = DirectionStatus::kGouge;
    return out;
  }
  if (focal >= -kFocalBand) {
    at_focal_point(foot, radial, out);
    return out;
  }
  out.lambda1 = -foot.k1 / (1.0 - radial.r * foot.k1);
  out.lambda2 = -foot.k2 / (1.0 - radial.r * foot.k2);
  out.gap = std::max({0.0, out.mu - out.lambda1, out.lambda2 - out.mu});
  if (radial.r * (out.lambda1 - out.lambda2) <= kUmbilicSpread)
    at_umbilic(out, radial.r);
  else
    at_ordinary_point(foot, radial, out);
  return out;
}

Vec3 axis_direction(const Footpoint& foot, const RadialJet& radial, double theta) {
  FLANK_ASSERT(std::abs(radial.d1) < 1.0);
  const double across = std::sqrt(1.0 - radial.d1 * radial.d1);
  return radial.d1 * foot.normal + across * (std::cos(theta) * foot.d1 + std::sin(theta) * foot.d2);
}

Pose contact_axis(const Footpoint& foot, double r, double s, const Vec3& direction) {
  FLANK_ASSERT(std::abs(direction.squaredNorm() - 1.0) < 1e-6);
  return {foot.point + r * foot.normal - s * direction, direction};
}

}  // namespace flank::internal
