/// What the strips of a given tool are sought with: data only.
#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

#include "flank/vec.h"

namespace flank {

/// A line that touches the target at one footpoint, by the sphere of s, in one direction of the tangent plane.
struct LineSeed {
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ();  ///< of the target, towards the machining side
  Vec3 direction = Vec3::UnitX();                     ///< unit, across the normal: where the holder end lies
  double s = 0.0;                                     ///< arc length of the sphere that touches, mm, in [0, L]
};

/// What the strategy `curves` can be tuned with; what the choices do is measured in docs/algorithms/curves.md.
struct CurvesOptions {
  /// Seeds: footpoints times values of s, both >= 1. Paper B takes 700 times 30 radii; ten times as many seeds cost
  /// twice the time and showed no gain.
  int places = 300, spheres = 7;
  int steps = 16;  ///< of an integral curve over the whole axis, >= 2 (IntegralCurveOptions::steps)
  /// How far a curve may turn; paper B: kStraightnessRad. 0: as far as its line may cost `slack` tolerances,
  /// 8 sqrt(2 r slack tolerance) / L, and that at least.
  double straightness_rad = 0.0;
  bool step_by_step = false;  ///< the turn is from one step to the next (paper B (13) as printed), not from the seed
  /// Tolerances that lines, and strips through them, may be off before SMOOTH, >= 1. With 1 there are too few lines at
  /// fine tolerances (14 % covered instead of 69 % on a blade at 0.02 mm).
  double slack = 3.0;
  /// REFINE each line, to one tolerance; paper B takes the lines as they are. Gives more before SMOOTH; after it the
  /// difference is mostly within the scatter.
  bool refine = false;
  int clusters = 200;      ///< k, >= 1; both 100 and 400 covered less at fine tolerances
  std::uint64_t seed = 1;  ///< of the clustering; it decides over ten percent of a difficult face, so try several
  /// Share of a strip's area in [0, 1] that may be covered by those chosen before it; paper B's 5 percent.
  double most_overlap = 0.05;
  /// Share of the area in [0, 1] that a strip must add before SMOOTH, which closes smaller gaps. Lower it for more
  /// coverage with more strips; 0.04 missed a third of a face.
  double least_gain = 0.02;
};

/// Where on the target lines are begun.
enum class SeedPlaces {
  kGrid,   ///< spread evenly
  kShape,  ///< more where the target bends more (shape_places.h)
};

/// In which directions of the tangent plane they are begun.
enum class SeedDirections {
  kEven,        ///< seed_directions over half a turn
  kAdmissible,  ///< those that the tolerance-aware filter leaves, at seed_spheres values of s (direction_filter.h)
};

enum class CoverStrategy {
  kGrow,   ///< lines refined and grown, tiled, chosen by value
  kCurves  ///< paper B: integral curves, lines, clusters, groups (curves.h)
};

struct CoverOptions {
  /// kGrow covers more at fine tolerances; kCurves takes about half the time and is there to compare
  /// (docs/algorithms/curves.md).
  CoverStrategy strategy = CoverStrategy::kGrow;
  CurvesOptions curves;  ///< of kCurves alone
  /// mm, > 0: the largest |f| that counts as finished, and the deepest that the tool may enter the target or another
  /// face. Time grows as it falls: about threefold from 0.05 to 0.02 mm on a blade.
  double tolerance_mm = 0.01;
  /// Within `turn_window_mm` of the way of both ends of the axis a strip turns by no more than this; <= 0: by any angle. Else it is cut there.
  double most_turn_rad = 15.0 * std::numbers::pi / 180.0;
  double turn_window_mm = 0.0;            ///< > 0; 0: sqrt(2) percent of the target's diagonal
  std::vector<LineSeed> seeds;            ///< where strips of kGrow begin; empty: as the next five options say
  SeedPlaces places = SeedPlaces::kGrid;  ///< neither is ahead; kShape suits a target that bends strongly in few places
  SeedDirections directions = SeedDirections::kAdmissible;  ///< kEven: twice as many seeds for the same coverage
  int seed_places = 30;  ///< places, >= 1. Raise it if a face falls into many parts that need strips of their own
  /// Even directions over half a turn, >= 1; also used if no admissible one leads to a strip.
  int seed_directions = 12;
  /// Values of s for admissible directions, >= 1. Raise it for a tool whose curvature varies along s.
  int seed_spheres = 3;
  int most_strips = 16;  ///< >= 1. A safeguard: strip_price ends the search long before on most faces
  /// Share of the area in [0, 1) that a strip must add, to be worth its time. Lower it for the last parts of a percent:
  /// 0.0005 takes an impeller from 99.0 % in 2 strips to 99.6 % in 6.
  double strip_price = 0.005;
  /// Overlap of a strip with the neighbour that it is grown beside, in axis lengths, in [0, 1). It is room for rails
  /// that do not follow an edge exactly; SMOOTH closes what gaps it leaves.
  double overlap_share = 0.04;
  /// Spacing of the samples that measure strips, as a share of the root of the area, > 0: 1 / 0.02^2 = 2500 cells. What
  /// is narrower is not seen while strips are chosen. Time grows with its inverse square.
  double sample_share = 0.02;
  /// The same of those that certify and report strips: about 5900 cells; at most sample_share.
  double dense_share = 0.013;
  /// Of a smoothed strip, for each rail, >= 4; doubled if a certificate fails. Raise it for long strips on targets with
  /// ripples; time of SMOOTH grows with it.
  int control_points = 24;
  double enough_coverage = 1.0;  ///< tilings stop at this share of the area, in (0, 1]; below 1 for quick looks
  /// Whether strips are fitted together at the end. Off: as they grew, certified, in a fraction of the time and with
  /// more ripples; for rankings.
  bool smooth = true;
};

}  // namespace flank
