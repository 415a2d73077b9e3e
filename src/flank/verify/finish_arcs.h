/// What a path engages that takes stock of even thickness off its targets: finishing, after roughing has left so much.
#pragma once

#include <vector>

#include "flank/judge.h"
#include "flank/path/engaged_arcs.h"

namespace flank::internal {

/// The arcs on which the front of the tool lies in that stock: no farther from a target than its thickness, by the tangent planes of the
/// nearest samples, and opposite to the target. As if no strip had been there before. `targets` have normals; samples that are no
/// targets are left out. Throws UsageError for a thickness or spacing that is not > 0. The same bits for any number of threads.
[[nodiscard]] PathArcs finish_arcs(const RadialFunction& radial, const Path& path,
                                   const std::vector<FaceSamples>& targets, double thickness_mm, int rings = 17);

}  // namespace flank::internal
