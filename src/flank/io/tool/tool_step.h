/// tool.step (docs/schema/step.md): the tool as solids of revolution.
#pragma once

#include <string>

#include "flank/tool.h"

namespace flank::internal {

/// How far the solid's flank may be from the meridian that the spheres envelope, mm.
inline constexpr double kStepMeridianMm = 1e-4;

/// The whole file (AP214, millimetres), the same bytes for the same tool. The axis is z, s = 0 the origin, the holder
/// towards +z. Objects: "flank" (the sphere of s = 0 below, the meridian, a flat end at the meridian point of s = L),
/// and "shank" and "holder" where the tool has them; each a closed solid. Throws InputError for a radial function that is
/// not legitimate: its spheres envelope no profile.
[[nodiscard]] std::string tool_to_step(const Tool& tool);

}  // namespace flank::internal
