/// What a wheel's operations leave, by place, depth and reason.
#pragma once

#include <vector>

#include "flank/triangle_mesh.h"
#include "flank/wheel/wheel_work.h"

namespace flank::internal {

/// Connected places of the flow surface on which more than the tolerance is left, largest first, and their triangles. Of the whole as it
/// was judged; places below a blade's foot or inside other material do not count.
struct WheelRest {
  std::vector<RestPlace> places;
  TriangleMesh mesh;
};
[[nodiscard]] WheelRest rest_of(WheelWork& work, const Result& whole);

}  // namespace flank::internal
