/// The search for a cavity's tool, side paths and program: from thick tools to thin ones.
#pragma once

#include <string>
#include <vector>

#include "flank/pipeline/cavity_faces.h"
#include "flank/trochoid/program.h"
#include "flank/trochoid/side_fit.h"

namespace flank::internal {

struct CavityPlan {
  SideFit sides;                   ///< no motions: no start was free
  CavityProgram program;           ///< none if the tool is not legitimate
  double largest_radius_mm = 0.0;  ///< the bound under which the tool was found
  int tools = 0;                   ///< bounds that were tried
};

/// The first tool whose sides are done and whose cycles get through, of bounds from thick to thin; if there is none, the one
/// whose cycles get through and whose sides are best; else the one whose sides are best. The search ends where a thinner bound
/// gains nothing. `options.fit.bounds.largest` is what the narrowest place has room for; where most of the cavity is much
/// wider, thicker bounds come first, unless the job has one. A tool that is given is tried alone.
[[nodiscard]] CavityPlan search_cavity(const TrochoidJob& job, const CavityFaces& faces, const ToolModel& tool,
                                       const SideFitOptions& options, const Progress& progress);

}  // namespace flank::internal
