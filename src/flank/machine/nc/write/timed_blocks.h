/// From blocks with the time that each shall take to what programs state: rounded to their digits, with feeds.
#pragma once

#include <vector>

#include "flank/machine/nc/dialect.h"

namespace flank::internal {

/// How long a block shall take, and how far the rotary axis that turns most turns in it.
struct BlockTime {
  double seconds = 0.0;
  double turn_deg = 0.0;
};

/// The slowest feed of the controlled point, mm/min, that the control keeps in inverse time while rotary axes turn; 0: it keeps
/// any. LinuxCNC runs no block of inverse time slower than 0.1 mm/min: a turn with less of a way would be run as fast as the
/// axes can.
[[nodiscard]] double slowest_turning_feed(const NcProgram& program, const NcDialect& dialect);

/// Rounds positions and rotary values to the dialect's digits and states the feed with which each feed move takes its time
/// (times: one for each move; that of a rapid is not looked at). F is of the way that is written: where that is none, of the
/// rotary axes, degrees per minute. A block in which the point would be slower than slowest_turning_feed turns the axes alone,
/// the point held; the way that is left is made good by a block of its own as soon as it is more than `hold_mm` (> 0).
/// Returns the farthest that the point is held back, mm.
double state_feeds(NcProgram& program, const std::vector<BlockTime>& times, const NcDialect& dialect, double hold_mm);

}  // namespace flank::internal
