/// Regularity of the envelope along a path as it is written: one figure for the summary and for the report.
#pragma once

#include <functional>

#include "flank/path.h"
#include "flank/radial_function.h"

namespace flank::internal {

/// Does the ball of this centre and radius, mm, touch what is to be machined? Left empty: everything counts as touched.
using Touches = std::function<bool(const Vec3& centre, double radius_mm)>;

/// Largest |c| (docs/MATH.md, section 3) of the straight join from one pose to the next, at its middle, over the places of
/// the axis whose inscribed ball touches, and `known`, that of other steps: places below it are not asked for.
/// Where the flank is in the air, or beside the target, it leaves no surface that could be wrong.
[[nodiscard]] double largest_c(const Pose& from, const Pose& to, const RadialFunction& radial,
                               const Touches& touches = {}, double known = 0.0);

/// The largest over all steps of all strips; 0 for a path without a step.
[[nodiscard]] double largest_c(const Path& path, const RadialFunction& radial, const Touches& touches = {});

}  // namespace flank::internal
