/// GROW (MATH section 8): from one line within tolerance to the strip that it sweeps, both ways.
#pragma once

#include <vector>

#include "flank/obstacle/line_guard.h"
#include "flank/strip/line_fit.h"

namespace flank::internal {

struct GrowOptions {
  double first_step_share = 0.02;  ///< step lengths, as shares of the target's diagonal
  double longest_step_share = 0.06;
  double shortest_step_share = 0.004;
  double longest_travel_share = 4.0;
  double overrun_share = 0.01;  ///< travel past the border
};

/// A neighbour whose edge a strip follows: one end of the axis stays `overlap_mm` within the neighbour's other end.
struct GrowGuide {
  const std::vector<Pose>* neighbour = nullptr;
  bool beyond_tip = true;  ///< the new strip lies past the neighbour's tip, else past its holder end
  double overlap_mm = 0.0;
};

/// Why a strip ended on one side.
enum class GrowEnd {
  kNotRun,
  kBorder,     ///< no footpoint lies inside the target any more
  kTolerance,  ///< the error exceeds the tolerance however short the step
  kCheck,      ///< the tool would enter another face
  kTravel,     ///< longest_travel_share diagonals: a closed target
};

struct GrownStrip {
  std::vector<Pose> poses;
  GrowEnd first = GrowEnd::kNotRun, last = GrowEnd::kNotRun;
};

/// Slide along the axis, mm, that brings the pose's end to the neighbour's edge; 0 past the ends of the neighbour.
[[nodiscard]] double guide_slide(const GrowGuide& guide, const Pose& pose, double axis_length);

/// Grows the strip of `line`, which is within tolerance. Every step: predictor (the most movable transversal velocity),
/// slide to the guide, corrector (refine with the travel held), certificates at its end and its middle; halved until
/// they hold. `fitter` is scratch.
[[nodiscard]] GrownStrip grow(LineFitter& fitter, const LineGuard& guard, const LineFit& line, const GrowGuide& guide,
                              const GrowOptions& options = {});

}  // namespace flank::internal
