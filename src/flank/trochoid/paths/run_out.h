/// How the side paths of a cavity go on beyond their ends: together, and clear of all faces.
#pragma once

#include <limits>

#include "flank/trochoid/paths/half_guard.h"
#include "flank/trochoid/paths/side_path.h"

namespace flank::internal {

/// Beyond their ends both paths bend over a radius towards one direction, the mean of their last quarters across the axis:
/// from there on they neither meet nor part.
void join_run_outs(SidePath& a, SidePath& b, double radius_mm);

/// Of the radius: run-outs that enter a face deeper than this lead to a wall.
inline constexpr double kWall = 0.2;

/// How deep run-outs enter faces, beyond what is allowed and what the ends of the sides enter themselves, and how far they go before
/// they do, mm: infinitely far if they enter nothing that deep.
struct RunOutDepth {
  double start = 0.0, end = 0.0;
  double free_start = std::numeric_limits<double>::infinity(), free_end = std::numeric_limits<double>::infinity();
};

/// The same, but where a path then enters a face it bends more gently, or to one side, and both rise along the axis, as little as
/// it takes; if nothing keeps them clear by `allowed_mm`, what enters least, and where that is a wall, what goes farthest before it.
/// What the ends of the sides enter themselves does not count.
RunOutDepth join_run_outs(SidePath& a, SidePath& b, double radius_mm, const HalfGuard& guard, double allowed_mm);

/// So far beyond an end a path enters no face by more than is allowed, nor deeper than its end does, mm; at most `most_mm`.
[[nodiscard]] double free_run_out(const SidePath& path, bool end, double most_mm, const HalfGuard& guard,
                                  double allowed_mm);

/// How deep a path may be at a wall: in the wall, across the way, and in the side that it goes on along, mm.
struct WallDepths {
  double wall_mm = 0.0, side_mm = 0.0;
};

/// How far beyond its end a path may go before the wall there, mm: from a way on that is known to be free up to where it enters a face
/// by more than is allowed, or than its end does, within the rounding of a search by halves. No more than a radius farther.
[[nodiscard]] double way_to_wall(const SidePath& path, double free_mm, double radius_mm, const HalfGuard& guard,
                                 const WallDepths& allowed);

}  // namespace flank::internal
