/// How long a control takes for a program, where that is longer than its feeds say.
#pragma once

#include <vector>

#include "flank/machine/model/machine.h"
#include "flank/machine/nc/program.h"

namespace flank::internal {

/// Whether the control comes to rest at the end of every block: LinuxCNC with rotary axes, on the exact path (G61) always, within a tolerance
/// (G64 P) nearly so.
[[nodiscard]] bool rests_between_blocks(const Machine& machine, const NcProgram& program);

/// Of each move the time of a way from rest to rest, s: at the speed of its feed where there is room, each axis of the program within its speed,
/// acceleration and jerk (those of the machine's joint of that name). 0 for rapids. Of programs with axes, not vectors.
[[nodiscard]] std::vector<double> resting_seconds(const Machine& machine, const NcProgram& program);

}  // namespace flank::internal
