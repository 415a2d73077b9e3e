/// A tool that is thicker by a constant: where it touches a surface, the tool itself keeps off that surface by the constant.
#pragma once

#include "flank/tool.h"

namespace flank::internal {

/// r(s) + mm, in the same family; exact. Of the family power, which has no such member, a spline that is off by at most
/// kGrownErrorMm where r is smooth over the axis. mm may be negative; whether the result is a tool check_legitimacy says.
[[nodiscard]] RadialFunction grown(const RadialFunction& radial, double mm);
inline constexpr double kGrownErrorMm = 1e-7;

/// The same of a tool. Shank and holder stay as they are.
[[nodiscard]] Tool grown(const Tool& tool, double mm);

}  // namespace flank::internal
