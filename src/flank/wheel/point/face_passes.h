/// Passes of a tool's tip sphere along one face, edge, fillet or side: point contact (docs/MATH.md, section 14).
#pragma once

#include <string>
#include <vector>

#include "flank/face.h"
#include "flank/path.h"
#include "flank/radial_function.h"
#include "flank/wheel/point/channel.h"

namespace flank::internal {

/// Strips along the parameter lines of the face's longer direction, from border to border, as far apart as the scallop allows where the
/// face bends most. The axes are chosen as on a floor. What is finished needs no pass; a pose without room is left out, and the strip
/// ends where its room does. `around`: its walls are all faces that the tool keeps out of, this one and the floor among them; it has no
/// floor and no sides.
[[nodiscard]] std::vector<Strip> face_passes(const Face& face, const FloorChannel& around, const RadialFunction& radial,
                                             const PointOptions& options, const std::string& kind,
                                             const std::string& name);

}  // namespace flank::internal
