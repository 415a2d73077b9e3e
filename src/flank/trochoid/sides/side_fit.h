/// Side paths of a cavity: one tool for both sides and all layers, by the flank fit (docs/algorithms/fit.md), started on
/// both sides at once.
#pragma once

#include <optional>

#include "flank/base/step_codec.h"
#include "flank/trochoid/sides/side_start.h"

namespace flank::internal {

/// A radius to start with, mm, and the least radius that a free tool may then have, as a share of it.
struct RadiusStart {
  double radius_mm = 1.0, least_share = 0.3;
  /// Not tried where another start covers as much of what its tool reaches of both sides; above 1: always tried.
  double unless_covered = 2.0;
  double tip_share = 1.0;  ///< radius of the tip, as a share of it: below 1 the tool is a cone to begin with
};

struct SideFitOptions {
  FlankFitOptions fit;
  int layers = 1;
  /// What to start with, the best first: the first with which the sides are done is kept, else the best of them.
  std::vector<RadiusStart> starts;
  double least_coverage = 0.97;  ///< of what is reachable, planner's estimate, that counts as done
  std::optional<Vec3> up;        ///< from the floor to the open top, if it is known
  /// Whether a start may be more slender than the bounds allow where even a cylinder as thick as they allow is: then nothing holds
  /// the tool but its radius. Else it is left out, for more layers, whose tool is shorter: a fit between bounds that no tool
  /// keeps goes astray.
  bool slender = true;
  /// Every pass draws the axes of both sides to the same lean, so that a cycle need not turn the tool along its way. Where
  /// walls ask for something else that costs coverage, or leads the cycles into a corner.
  bool facing = true;
};

struct SideFit {
  /// motions[2 k] of the left side, [2 k + 1] of the right one, in layer k, the top one first. Both run in the same
  /// direction along the cavity, tips at the same end. Empty: no start.
  FlankFitResult fit;
  RadiusStart start;  ///< that it began with
  int tried_radii = 0;
  /// Not of a free tool that covers clearly less than is asked for: the next layers, or the next bound, may do better, and the
  /// last passes take longer than all before them. What is milled is settled first (settle_sides).
  bool settled = true;
  bool facing = true;  ///< as its options had it
};

/// Among the values of a finished step (base/step_codec.h).
void code(StepCodec& codec, SideFit& sides);
void code(StepCodec& codec, RadiusStart& start);

/// Distances of the two sides from each other, mm, over samples of the left one.
struct CavityWidth {
  double narrowest_mm = 0.0, median_mm = 0.0;
};

/// Of samples at which something can be milled: where another face covers the side, or the sides meet below it, it has no width.
/// Zero if no place is free.
[[nodiscard]] CavityWidth width_between(const CavitySide& left, const CavitySide& right);

/// Of samples of both sides, the share at which a ball of the radius fits between the other faces: what a tool can cover.
[[nodiscard]] double reachable_share(const CavitySide& left, const CavitySide& right, double radius_mm);

/// Whether `covered` of both sides is the share asked for of what a ball of the radius reaches. Beside a floor a thin tool
/// reaches farther than a stout one, which is not asked for that.
[[nodiscard]] bool covers_reachable(const CavitySide& left, const CavitySide& right, double covered,
                                    double least_coverage, double radius_mm);

/// Cosine of the angle between the normals of sides that face each other, mean over samples: -1 for parallel walls, above
/// 0 they do not face.
[[nodiscard]] double facing(const Target& left, const Target& right);

[[nodiscard]] SideFit fit_sides(const CavitySide& left, const CavitySide& right, const ToolModel& tool,
                                const SideFitOptions& options, const Progress& progress);

/// Sides that were left unsettled, after the last passes: looked at closely, and led out of what they cut and enter. `options`:
/// those of their fit.
[[nodiscard]] SideFit settle_sides(const CavitySide& left, const CavitySide& right, SideFit sides,
                                   const SideFitOptions& options, const Progress& progress);

}  // namespace flank::internal
