#include "flank/seed/direction/direction_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

/// A sphere that is too large for the hollow, judged as the one that just fits: its radius is the focal distance.
struct Fitted {
  RadialJet radial;
  double excess_mm = 0.0;
};

Fitted fit_into_hollow(const Footpoint& foot, const RadialJet& radial) {
  Fitted out{radial, 0.0};
  if (!(foot.k2 * radial.r > 1.0 - kFocalBand)) return out;
  out.radial.r = 1.0 / foot.k2;
  out.excess_mm = std::max(0.0, radial.r - out.radial.r);
  return out;
}

void take_angles(const Footpoint& foot, const RadialJet& radial, std::initializer_list<double> angles,
                 CandidateDirections& out) {
  for (const double theta : angles)
    out.directions[static_cast<std::size_t>(out.count++)] = axis_direction(foot, radial, theta);
}

/// No root, but near: d1 and d2 are the ends of the range of lambda, so one of them is off least. At an umbilic all
/// directions are alike, and four even ones stand for them.
void clamp(const Footpoint& foot, const RadialJet& radial, const AdmissibleDirections& fitted,
           CandidateDirections& out) {
  constexpr double kHalfTurn = std::numbers::pi;
  if (out.every)
    take_angles(foot, radial, {0.0, 0.5 * kHalfTurn, kHalfTurn, 1.5 * kHalfTurn}, out);
  else
    take_angles(foot, radial, {fitted.theta, fitted.theta + kHalfTurn}, out);
}

/// Whether there are directions of exact second order contact (MATH.md, section 5).
bool has_roots(DirectionStatus status) {
  return status == DirectionStatus::kFour || status == DirectionStatus::kTwo || status == DirectionStatus::kEvery;
}

/// The first test is for a focal point of a sphere, where both are minus infinity and their difference is no number.
bool is_umbilic(const AdmissibleDirections& found, double r) {
  return found.lambda1 == found.lambda2 || r * (found.lambda1 - found.lambda2) <= kUmbilicSpread;
}

}  // namespace

CandidateDirections candidate_directions(const Footpoint& foot, const RadialJet& radial,
                                         const DirectionFilterOptions& options) {
  FLANK_ASSERT(options.contact_length_mm > 0.0 && options.tolerance_mm > 0.0);
  CandidateDirections out;
  const Fitted fitted = fit_into_hollow(foot, radial);
  const AdmissibleDirections found = admissible_directions(foot, fitted.radial);
  if (found.status == DirectionStatus::kNotATool) {
    out.error_mm = std::numeric_limits<double>::infinity();
    return out;
  }
  // The slope of the fitted sphere is that of the tool: only its radius was changed.
  const double q = 1.0 - radial.d1 * radial.d1, length = options.contact_length_mm;
  out.every = is_umbilic(found, fitted.radial.r);
  // MATH.md, section 5: a gap of second derivatives over the contact length is off by about gap q L^2 / 16, plus what
  // the sphere is too large for the hollow.
  out.error_mm = fitted.excess_mm + q * found.gap * length * length / kParabolaShare;
  if (has_roots(found.status)) {
    out.candidate = Candidate::kReal;
    out.count = found.count;
    out.directions = found.directions;
    if (out.every) clamp(foot, radial, found, out);
  } else if (out.error_mm <= options.slack * options.tolerance_mm) {
    out.candidate = Candidate::kNear;
    clamp(foot, radial, found, out);
  }
  return out;
}

SearchSpace count_search_space(std::span<const Footpoint> feet, const RadialFunction& radial, int spheres,
                               const DirectionFilterOptions& options) {
  FLANK_ASSERT(spheres >= 1);
  SearchSpace space;
  DirectionFilterOptions filled = options;
  if (filled.contact_length_mm <= 0.0) filled.contact_length_mm = radial.axis_length();
  for (const Footpoint& foot : feet) {
    for (int j = 0; j < spheres; ++j) {
      const RadialJet jet = radial.at((j + 0.5) / spheres * radial.axis_length());
      const CandidateDirections found = candidate_directions(foot, jet, filled);
      ++space.pairs;
      if (found.candidate == Candidate::kReal) ++space.real;
      if (found.candidate == Candidate::kNear) ++space.near;
      if (found.candidate != Candidate::kRejected) continue;
      ++space.rejected;
      const double room = foot.k2 > 0.0 ? 1.0 / foot.k2 : std::numeric_limits<double>::infinity();
      // Counted apart: these are rejected because they would gouge, whatever their direction.
      if (jet.r - room > filled.slack * filled.tolerance_mm) ++space.gouging;
    }
  }
  return space;
}

}  // namespace flank::internal
