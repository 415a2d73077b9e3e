/// The fillets that a target runs into.
#pragma once

#include <optional>
#include <vector>

#include "flank/part.h"

namespace flank::internal {

/// Radius of the tightest fillet at the border of `faces` (indices), mm, if it is below `below_mm`: of a face of the same solid that
/// is joined smoothly to one of them along a good part of its width and bends towards the outside of the part, all along its border
/// with about one radius. None for sheets and meshes, which do not tell what is outside, and for faces that end at sharp edges only.
[[nodiscard]] std::optional<double> tightest_fillet(const Part& part, const std::vector<int>& faces, double below_mm);

}  // namespace flank::internal
