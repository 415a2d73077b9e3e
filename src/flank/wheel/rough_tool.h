/// The tool that roughs a wheel.
#pragma once

#include <string>

#include "flank/tool.h"
#include "flank/wheel/point/channel.h"
#include "flank/wheel/wheel_work.h"

namespace flank::internal {

constexpr double kRoughAllowanceMm = 0.3;  ///< that roughing leaves on all faces

/// The same, and by how much the blades differ: one sector's passes do for all.
[[nodiscard]] double rough_allowance(const WheelWork& work);

/// What passes of roughing on the floor are planned with.
[[nodiscard]] PointOptions rough_options(WheelWork& work, const Tool& tool);

/// "T2", then the work's roughing tool and in its folder, where a tool larger than T1 fits and may be had; else "T1". It comes to most of the floor
/// that T1 comes to: a rim or a foot may leave it less room than the blades do.
[[nodiscard]] std::string choose_rough_tool(WheelWork& work);

}  // namespace flank::internal
