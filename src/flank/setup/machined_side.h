/// Which side of the targets is machined: the one rule, for every command, tolerance and tool (docs/algorithms/side.md).
#pragma once

#include <string>
#include <vector>

#include "flank/job.h"
#include "flank/judge.h"
#include "flank/part.h"

namespace flank::internal {

/// Turns the targets, indices of faces, so that their normals point to the side that is machined, and says which side that is of those
/// that bound no material. By the part's geometry alone: away from the material of a solid; else as asked; two walls of a cavity
/// towards each other; away from what they, or they and other faces, enclose; else where the normal of the file points. Of a mesh
/// triangles are turned. Throws UsageError where `side` asks for the material's side of targets of which all bound a solid.
[[nodiscard]] std::vector<SheetSide> turn_to_machined_side(const PartRequest& request, const std::vector<int>& targets,
                                                           Part& part);

/// "side +, towards (0.31, 0.94, 0.10), mostly +Y: where the normal of the file points".
[[nodiscard]] std::string side_text(const SheetSide& side);

}  // namespace flank::internal
