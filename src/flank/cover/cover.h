/// A given tool: the strips with which it finishes a target (MATH section 8; docs/algorithms/cover.md).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "flank/cover/curves/curves_options.h"
#include "flank/obstacle/line_guard.h"
#include "flank/progress.h"
#include "flank/ruled_motion.h"
#include "flank/seed/direction/seeds.h"
#include "flank/target.h"
#include "flank/tool.h"

namespace flank::internal {

/// Where on the target lines are begun.
enum class SeedPlaces {
  kGrid,   ///< spread evenly
  kShape,  ///< more where the target bends more (shape_places.h)
};

/// In which directions of the tangent plane.
enum class SeedDirections {
  kEven,        ///< seed_directions over half a turn
  kAdmissible,  ///< those that the tolerance-aware filter leaves, at seed_spheres values of s (direction_filter.h)
};

enum class CoverStrategy {
  kGrow,   ///< lines refined and grown, tiled, chosen by value
  kCurves  ///< paper B: integral curves, lines, clusters, groups (curves.h)
};

struct CoverOptions {
  CoverStrategy strategy = CoverStrategy::kGrow;
  CurvesOptions curves;
  double tolerance_mm = 0.01;
  std::vector<LineSeed> seeds;  ///< empty: as the next lines say
  SeedPlaces places = SeedPlaces::kGrid;
  SeedDirections directions = SeedDirections::kAdmissible;
  int seed_places = 30, seed_directions = 12,
      seed_spheres = 3;  ///< even directions also where no admissible one leads on
  int most_strips = 16;
  double strip_price = 0.005;    ///< share of the area that a strip must add, to be worth its time
  double overlap_share = 0.04;   ///< of neighbouring strips, in axis lengths
  double sample_share = 0.02;    ///< spacing of the samples that measure strips, as a share of the root of the area
  double dense_share = 0.013;    ///< the same of those that certify and report them
  int control_points = 24;       ///< of a smoothed strip, a rail; doubled where the certificate fails
  double enough_coverage = 1.0;  ///< no strip is added beyond this share of the area
  bool smooth = true;
};

enum class CoverStatus {
  kNotRun,
  kCovered,  ///< strips were found, and they cover something
  kNoLine,   ///< no line touches the target within the tolerance over its whole length
  kNoStrip,  ///< lines do, but none can move, or every strip would enter another face
};

struct CoverResult {
  CoverStatus status = CoverStatus::kNotRun;
  std::string message;
  std::vector<RuledMotion> motions;  ///< one a strip, in the order of machining
  double reachable =
      1.0;  ///< area share where a ball of the tool's smallest radius enters no obstacle (MATH section 9)
  /// Area share of the reachable part that is within tolerance before smoothing, by the planner's own estimate.
  double coverage_before = 0.0;
  double coverage = 0.0;                ///< and of `motions`
  double overlap = 0.0;                 ///< sum of the strips' covered areas over that of their union, less 1
  double overcut_mm = 0.0;              ///< largest depth of a strip in the target
  int seeds = 0, lines = 0, grown = 0;  ///< lines: seeds that refine to within tolerance; grown: candidates
  std::vector<std::string> notes;
  std::vector<std::pair<std::string, double>> seconds;  ///< wall time of the stages
};

/// Finds the strips. The tool enters no obstacle by more than the tolerance; a strip that would is cut short or dropped.
/// Same result for any number of threads.
[[nodiscard]] CoverResult cover(const Target& target, const Tool& tool, const CoverObstacles& obstacles,
                                const CoverOptions& options, const Progress& progress);

}  // namespace flank::internal
