/// Admissible directions (MATH section 5; paper B (5)-(12) and remarks 2, 3): in which directions can the tool's axis
/// leave the sphere of s that touches the target at a footpoint, so that the tool touches to second order?
///
/// Wanted are the unit vectors u with d(c + x u) = r(s + x) up to and including x^2, c = point + r n the centre of the
/// sphere, d the distance to the target. With q = 1 - r'^2 and mu = r''/q, both along
///   u = r' n + sqrt(q) (cos(theta) d1 + sin(theta) d2),
/// the second derivative of d is q (lambda1 cos^2 + lambda2 sin^2), lambda_i = -k_i / (1 - r k_i), which is to be r'':
///   cos^2(theta) = (1 - r k1) (mu (1 - r k2) + k2) / (k2 - k1).
/// Nothing is divided by a curvature, so flat directions are ordinary, and r(s) = h is never inverted, so a radius
/// that occurs at several s is ordinary too. Paper B's (11), (12) say the same with rho_i = 1 / k_i.
///
/// On the sphere's side of the focal points every lambda is below 1 / r. So whoever asks mu in [lambda2, lambda1] has
/// asked 1 - r'^2 - r r'' > 0 already (MATH section 1).
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "flank/radial_function.h"
#include "flank/target.h"
#include "flank/vec.h"

namespace flank::internal {

/// By how much cos^2(theta) may leave [0, 1] and still count as its end, and by how much it may stay inside and do so:
/// the principal direction then solves the second-order equation to this share of lambda1 - lambda2. No unit.
inline constexpr double kMergedRoots = 1e-12;
/// A footpoint is umbilic if r (lambda1 - lambda2) is at most this; there mu fits if r |mu - lambda| is. No unit.
inline constexpr double kUmbilicSpread = 1e-9;
/// Half-width in r k2 of the band that counts as focal. No unit.
inline constexpr double kFocalBand = 1e-9;

/// k2 >= k1 is the larger curvature (towards the machining side), lambda1 >= lambda2.
enum class DirectionStatus {
  kNotATool,  ///< not (r > 0 and |r'| < 1), or a number that is not finite
  kGouge,     ///< r k2 > 1 + kFocalBand: the sphere is larger than the target's curvature allows
  kFocal,     ///< |r k2 - 1| <= kFocalBand: the sphere osculates, d has no second derivative across d1
  kNone,      ///< mu > lambda1 or mu < lambda2: no real root
  kTwo,       ///< mu is an end of [lambda2, lambda1] to kMergedRoots: +-d1 or +-d2
  kFour,      ///< lambda2 < mu < lambda1
  kEvery      ///< umbilic and mu = lambda to kUmbilicSpread: every theta
};

struct AdmissibleDirections {
  DirectionStatus status = DirectionStatus::kNotATool;
  Vec3 centre = Vec3::Zero();  ///< of the sphere of s, mm: point + r n
  double mu = 0.0;             ///< r'' / (1 - r'^2), 1/mm
  double lambda1 = 0.0;        ///< second derivative of d along d1, 1/mm
  double lambda2 = 0.0;        ///< the same along d2; minus infinity at a focal point. Both 0 for kNotATool, kGouge
  double gap = 0.0;  ///< distance of mu to [lambda2, lambda1], 1/mm; to lambda1: kFocal; infinite: kNotATool, kGouge
  /// Of the first root, in [0, pi/2]; kNone: of the principal direction nearest to one; kFocal: 0, of d1.
  double theta = 0.0;
  int count = 0;  ///< 4, 2 or 0 roots; 0 for kEvery: ask axis_direction
  /// Unit, tip to holder, at theta, -theta, pi - theta, pi + theta; kTwo: theta, pi + theta.
  std::array<Vec3, 4> directions;

  [[nodiscard]] std::span<const Vec3> roots() const&& = delete;  // it would outlive the directions
  [[nodiscard]] std::span<const Vec3> roots() const& { return {directions.data(), static_cast<std::size_t>(count)}; }
};

/// All directions of the axis with second-order contact at the footpoint (its distance, parameters and location do not
/// matter) for the sphere of radial = r, r', r'' at s. Error: the equation of second order is kept to about 1e-14 of
/// the largest of its terms, so theta to the square root of that next to a merged root.
[[nodiscard]] AdmissibleDirections admissible_directions(const Footpoint& foot, const RadialJet& radial);

/// The direction with first-order contact at the angle theta from d1 towards d2. |r'| < 1.
[[nodiscard]] Vec3 axis_direction(const Footpoint& foot, const RadialJet& radial, double theta);

/// The axis with this direction (unit) whose sphere of s, of radius r, touches at the footpoint.
[[nodiscard]] Pose contact_axis(const Footpoint& foot, double r, double s, const Vec3& direction);

}  // namespace flank::internal
