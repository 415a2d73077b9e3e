/// What a tool has beyond its bounds, as residuals of a least-squares fit: zero inside the bounds.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "flank/fit.h"
#include "flank/radial_function.h"

namespace flank::internal {

/// One bound that is exceeded.
struct ToolExcess {
  double mm = 0.0;           ///< by how much, as a length; signed where a bound has two sides
  double share = 0.0;        ///< its weight in the mean over the axis
  Eigen::VectorXd gradient;  ///< of mm by all parameters of the radial function
};

/// Where a tool's bounds are asked: at the samples s (ascending, mm) and at a spline's knots, where its second derivative
/// has its peaks: between the samples alone a fit bent the profile until it was no tool. Ascending.
[[nodiscard]] std::vector<double> bound_places(const RadialFunction& tool, const std::vector<double>& s);

/// Every bound that the tool exceeds: radius, slope, convexity (1 - r'^2 - r r'' > 0, MATH section 1), neck and concave
/// curvature at the samples s (ascending, mm), slenderness as a whole. Numbers without unit are multiplied by the axis
/// length.
[[nodiscard]] std::vector<ToolExcess> tool_excesses(const RadialFunction& tool, const RadiusBounds& bounds,
                                                    const std::vector<double>& s);

/// Sum of share mm^2 over these, without gradients: cheaper.
[[nodiscard]] double tool_excess_square(const RadialFunction& tool, const RadiusBounds& bounds,
                                        const std::vector<double>& s);

}  // namespace flank::internal
