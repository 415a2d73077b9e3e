/// Plans the whole program of a cavity, layer by layer.
#pragma once

#include <vector>

#include "flank/progress.h"
#include "flank/trochoid/paths/half_guard.h"
#include "flank/trochoid/program.h"

namespace flank::internal {

/// `sides`: motions as fit_sides returns them. `faces[k]` guards layer k.
[[nodiscard]] CavityProgram plan_program(const std::vector<RuledMotion>& sides, const RadialFunction& radial,
                                         const Target& left, const Target& right, const GuardedFaces& faces,
                                         const ProgramOptions& options, const Progress& progress);

}  // namespace flank::internal
