/// The tolerance-aware filter (MATH section 5): which pairs of a footpoint and a sphere can carry a line within
/// tolerance? Real admissible directions are sufficient for second order and far from necessary: a cone is a fine tool
/// for a slightly elliptic side, and has no real direction anywhere on it.
///
/// Criterion. Along the best direction, the second derivative of d - r misses zero by q gap, q = 1 - r'^2. Over a line
/// of length L that leaves a parabola of height q gap L^2 / 8; shifted along the normal by half of it, an error of
///   e = q gap L^2 / 16.
/// A sphere that is too large for the target's hollow by r - 1/k2 adds that much (the line is judged at the focal
/// point, along d1). A pair is kept if e <= slack * tolerance. The slack stands for what the criterion does not see:
/// curvature that changes along the line, and a shift and tilt that share the error better than a parabola's.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "flank/seed/direction/admissible_directions.h"

namespace flank::internal {

/// Inverse of the factor in e = q gap L^2 / 16: a parabola's height over a length L is 1/8 of its second derivative
/// times L^2, and a shift along the normal leaves half of it on either side.
inline constexpr double kParabolaShare = 16.0;

struct DirectionFilterOptions {
  double tolerance_mm = 0.01;  ///< > 0, of the finished surface
  /// Length of axis whose contact lies on the target, mm: the tool's, or less if the target is smaller than the tool.
  /// 0: the tool's axis length.
  double contact_length_mm = 0.0;
  /// Tolerances that e may be, > 0. 1 loses up to a third of the usable pairs, 3 at most an eighth (table in
  /// docs/algorithms/directions.md). Larger keeps more seeds and costs their refinement.
  double slack = 3.0;
};

enum class Candidate {
  kReal,     ///< real roots: four, two, or every direction; e is then 0 up to round-off
  kNear,     ///< no real root, but e <= slack * tolerance: the principal direction nearest to a root
  kRejected  ///< e > slack * tolerance, or no tool
};

struct CandidateDirections {
  Candidate candidate = Candidate::kRejected;
  double error_mm = 0.0;  ///< e; infinite if the sphere is that of no tool
  bool every = false;  ///< umbilic: every direction is as good; directions has the four at theta = 0, pi/2, pi, 3 pi/2
  int count = 0;       ///< 0 if rejected
  std::array<Vec3, 4> directions;  ///< unit, tip to holder, with first-order contact

  [[nodiscard]] std::span<const Vec3> all() const&& = delete;  // it would outlive the directions
  [[nodiscard]] std::span<const Vec3> all() const& { return {directions.data(), static_cast<std::size_t>(count)}; }
};

/// The directions worth a seed at one footpoint for one sphere; contact_length_mm must be > 0 here. Costs 30 to 230 ns.
/// It promises nothing: a pair that is kept may carry no line, and one that is rejected may lie beside one that does.
[[nodiscard]] CandidateDirections candidate_directions(const Footpoint& foot, const RadialJet& radial,
                                                       const DirectionFilterOptions& options);

/// How much of the search space (footpoint, s) the two tests remove; paper B, figure 6.
struct SearchSpace {
  long pairs = 0;  ///< footpoints times values of s
  long real = 0, near = 0, rejected = 0;
  /// Of the rejected: the sphere is too large for a hollow by more than slack * tolerance.
  long gouging = 0;
  [[nodiscard]] double removed_by_real_roots() const { return pairs == 0 ? 0.0 : 1.0 - double(real) / double(pairs); }
  [[nodiscard]] double removed_by_filter() const { return pairs == 0 ? 0.0 : double(rejected) / double(pairs); }
};

/// Counts over the given footpoints and `spheres` (at least 1) values of s, the middles of equal pieces of [0, L]:
/// evenly in s, so that no radius is sought and none is missed.
[[nodiscard]] SearchSpace count_search_space(std::span<const Footpoint> feet, const RadialFunction& radial, int spheres,
                                             const DirectionFilterOptions& options);

}  // namespace flank::internal
