/// A tool as it came from the grinder: its radial function from points of its profile.
#pragma once

#include <string>
#include <vector>

#include "flank/tool.h"

namespace flank::internal {

struct GroundTool {
  RadialFunction radial;
  double noise_mm = 0.0;      ///< of the points, standard deviation, estimated
  double largest_mm = 0.0;    ///< largest difference of radius from the nominal tool, either way
  double rms_mm = 0.0;        ///< mean square of the same
  int used = 0;               ///< points that lie on the flank
  int elsewhere = 0;          ///< on tip ball, shank or beyond
  std::vector<int> outliers;  ///< indices of points that are left out, ascending
};

/// `points`: (z, radius) of the profile, mm, z along the axis from s = 0; both halves of a profile may be there (radius < 0).
/// The difference from `nominal` is a smooth spline, of as many coefficients as generalised cross-validation asks for.
/// Throws InputError, which begins with `file`: too few points on the flank, a part of it without points, another tool, no tool.
[[nodiscard]] GroundTool fit_ground(const RadialFunction& nominal, const std::vector<Vec2>& points,
                                    const std::string& file);

}  // namespace flank::internal
