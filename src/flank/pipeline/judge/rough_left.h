/// What roughing leaves on a wheel's flow surface.
#pragma once

#include "flank/path.h"
#include "flank/setup/setup.h"
#include "flank/tool.h"

namespace flank::internal {

/// mm, from the targets to what the tool sweeps: of half of their accessible area at most the median, of nine tenths at most the other one.
struct RoughLeft {
  double median_mm = 0.0, nine_tenths_mm = 0.0;
};

/// By samples, those of a face that stands for copies as often as there are any. `all`: the path with all of its copies. Accessible is what a
/// ball of this radius, mm, touches.
[[nodiscard]] RoughLeft left_by_roughing(const Setup& setup, const Tool& tool, const Path& all, double ball_mm);

}  // namespace flank::internal
