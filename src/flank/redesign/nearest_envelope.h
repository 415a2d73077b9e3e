/// The tool and the motions whose envelope is nearest to given faces (MATH section 17): no side of a face is preferred, unlike in a fit.
#pragma once

#include <functional>
#include <vector>

#include "flank/fit/polished.h"
#include "flank/fit/stages.h"
#include "flank/progress.h"

namespace flank::internal {

/// A figure of a point of a face.
using AtPoint = std::function<double(const Vec3&)>;

struct NearestProblem {
  FitDraft start;               ///< one motion for each face
  RadiusBounds bounds;          ///< of a free tool
  ReachLimits reach;            ///< what no ball of the tool gets to does not count, beside obstacles
  double tolerance_mm = 0.01;   ///< scale of fairness
  bool largest = false;         ///< the largest weighted deviation is made small; else the weighted mean square
  std::vector<AtPoint> weight;  ///< of each face: how much its deviation counts, > 0
  std::vector<AtPoint> least;   ///< of each face: the surface may lie so low at most, mm; empty: as low as it likes
};

struct NearestEnvelope {
  FitDraft draft;
  double rms_mm = 0.0, largest_mm = 0.0;  ///< weighted deviation over the points, of what is in reach
  double violation_mm = 0.0;              ///< by which `least` is missed, at most
};

/// Least squares over all control points and, of a free tool, its radii; under hard limits where there are any. For the largest
/// deviation weights follow it from round to round (Lawson). Deterministic for any number of threads.
[[nodiscard]] NearestEnvelope nearest_envelope(const NearestProblem& problem, const Progress& progress);

/// How much longer a motion and a free tool become, as shares of the way and of the axis.
struct Longer {
  double motion = 0.0;  ///< at both ends, where it goes on straight
  double top = 0.0;     ///< the tool at its upper end,
  double tip = 0.0;     ///< and at its tip
};

/// The draft with motions that run evenly from a little before their faces to a little behind them, longer by these shares. What a fit lets a
/// motion do where it touches nothing, as hook or rest, is cut off.
[[nodiscard]] FitDraft evenly_run(const FitDraft& draft, const Longer& longer);

}  // namespace flank::internal
