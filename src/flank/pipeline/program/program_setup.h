/// Whether a program is run as its set-up is: the frame, the tool, its length, the spindle and the machine.
#pragma once

#include <string>

#include "flank/job.h"
#include "flank/machine/backplot.h"
#include "flank/machine/model/machine.h"
#include "flank/machine/nc/program.h"
#include "flank/run.h"
#include "flank/tool.h"

namespace flank::internal {

/// Adds what the words of a program say otherwise than its set-up, by `file` and line: the request where it says something,
/// else the program's header, else the machine's file. `options` is what the program was backplotted with.
void accept_set_up(const NcRequest& request, const NcProgram& program, const Machine& machine, const Tool& tool,
                   const BackplotOptions& options, Acceptance& acceptance);

}  // namespace flank::internal
