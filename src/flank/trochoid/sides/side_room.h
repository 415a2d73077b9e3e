/// How much room the sides of a cavity leave to a tool: what it can reach of them, and how far it can go from one to the other.
#pragma once

#include <vector>

#include "flank/radial_function.h"
#include "flank/ruled_motion.h"
#include "flank/trochoid/sides/side_start.h"

namespace flank::internal {

/// Of samples of the left side, the share from which something else stands in the straight way to the right one, as a splitter does: no
/// front gets across there.
[[nodiscard]] double blocked_share(const CavitySide& left, const CavitySide& right);

/// Of samples of both sides, the share at which a ball fits between the other faces that has the radius of the tool at the
/// height at which it comes nearest there. A ball of the tool's least radius fits at more places: beside a wall a tool that is
/// thicker elsewhere ends before it. `motions`: of the left and the right side, in turn.
[[nodiscard]] double reach_of_tool(const CavitySide& left, const CavitySide& right,
                                   const std::vector<RuledMotion>& motions, const RadialFunction& tool);

/// Of the samples of both sides that are within the tolerance of what the tool sweeps, the share at which a ball of a radius fits
/// between the other faces: where what such a ball reaches is asked for, the rest counts for nothing. 1 if there are none.
[[nodiscard]] double covered_in_reach(const CavitySide& left, const CavitySide& right,
                                      const std::vector<RuledMotion>& motions, const RadialFunction& tool,
                                      double tolerance_mm, double radius_mm);

/// By how much the axes of all layers together are longer than a third more than their way, in ways: then they most likely lie along the
/// cavity, and its layers are not above one another but behind one another. Mean over the layers; 0 if they stand, 4 at most.
[[nodiscard]] double lying(const std::vector<RuledMotion>& motions);

/// The way from one side to the other where it is shortest, over all heights, in diameters of the tool at that height.
[[nodiscard]] double least_way_across(const std::vector<RuledMotion>& motions, const RadialFunction& tool);

}  // namespace flank::internal
