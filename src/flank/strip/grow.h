/// GROW (MATH section 8): from one line within tolerance to the strip that it sweeps, both ways.
///
/// A predictor-corrector walk with step control. What it accepts is certified at the end and at the middle of each
/// step, at the samples of the fitter; measure_strip and the certificates look at what lies between.
#pragma once

#include <vector>

#include "flank/obstacle/pose_guard.h"
#include "flank/strip/line_fit.h"

namespace flank::internal {

/// Lengths of travel of the middle of the axis, as shares of the target's diagonal. All > 0. They are settings that
/// work on the faces of docs/algorithms/cover.md; the tolerance comes in by the certificates alone.
struct GrowOptions {
  /// The first step, and the longest with which a line may leave the target. A larger one leaves less well joined.
  double first_step_share = 0.02;
  /// Steps grow by half up to this. It bounds how much of a ripple the samples at ends and middles may step over.
  double longest_step_share = 0.06;
  /// A step that would have to be shorter ends the strip. Lower it if strips end with kTolerance where the target bends
  /// strongly.
  double shortest_step_share = 0.004;
  /// Ends a strip on a closed target, which has no border: a way round a convex part is at most pi diagonals.
  double longest_travel_share = 4.0;
  /// Travel past the border, so that the last cells beside it are covered as well.
  double overrun_share = 0.01;
};

/// A neighbour whose edge a strip follows: the strip's end beside it stays `overlap_mm` within the neighbour's edge.
struct GrowGuide {
  /// Poses in their order, two or more; must outlive the guide; null: none.
  const std::vector<Pose>* neighbour = nullptr;
  bool beyond_tip = true;   ///< the new strip lies past the neighbour's tip, else past its holder end
  double overlap_mm = 0.0;  ///< along the axis, >= 0
};

/// Why a strip ended on one side.
enum class GrowEnd {
  kNotRun,
  kBorder,     ///< no footpoint lies inside the target any more
  kTolerance,  ///< the error exceeds the tolerance however short the step
  kCheck,      ///< the tool would enter another face
  kTravel,     ///< the travel exceeds longest_travel_share diagonals: a closed target
};

/// Poses in the order of travel, of uneven spacing: ends and middles of the steps. Empty if the line has no movability.
struct GrownStrip {
  std::vector<Pose> poses;
  GrowEnd first = GrowEnd::kNotRun, last = GrowEnd::kNotRun;
};

/// Slide along the axis, mm, towards the holder, that brings the pose's end to `overlap_mm` within the neighbour's
/// edge; 0 if the pose is past the ends of the neighbour. guide.neighbour must not be null.
[[nodiscard]] double guide_slide(const GrowGuide& guide, const Pose& pose, double axis_length);

/// Grows the strip of `line`, which must be within the fitter's tolerance, clear of the guard, and the fitter's current
/// line (line_fit.h). Every step: predictor (the most movable transversal velocity), slide to the guide, corrector
/// (refine with the travel held), certificates at its end and its middle; halved until they hold. Always has at least
/// the pose of the line, unless its movability is not valid.
[[nodiscard]] GrownStrip grow(LineFitter& fitter, const PoseGuard& guard, const LineFit& line, const GrowGuide& guide,
                              const GrowOptions& options = {});

}  // namespace flank::internal
