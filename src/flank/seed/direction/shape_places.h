/// Places for seeds that follow the target's shape: more where it bends more (Cohen-Steiner, Alliez, Desbrun 2004,
/// "Variational shape approximation"; paper B, section 4.1).
#pragma once

#include <vector>

#include "flank/target.h"

namespace flank::internal {

/// The target in about `count` connected regions, each as near to a plane as they can be made together: the error of a
/// region is the integral of |n - N|^2, N its mean normal (the metric L^{2,1}). They are added one by one, where the
/// error is largest, and grow from their best sample over neighbouring samples, the least error first; a dozen rounds
/// of that and of new mean normals follow. The result is the sample of each region whose normal is nearest to the mean,
/// the nearest to its centre among equals. Deterministic. Needs count > 0; fewer places come back only if the target
/// has fewer samples. Time: count + 12 floodings of 40 count samples.
[[nodiscard]] std::vector<SurfaceSample> shape_places(const Target& target, int count);

}  // namespace flank::internal
