/// A mixed-flow impeller by formulas: main blades and splitters on a sector of their hub.
#pragma once

#include <vector>

#include "flank/face.h"
#include "flank/io/cad/write_solid.h"

namespace flank::internal {

inline constexpr int kImpellerPairs = 2;  ///< main blades in the sector, each with the splitter behind it
/// Angle about the X axis between main blades, as between six of them; splitters stand half-way.
inline constexpr double kImpellerPitchRad = 3.14159265358979323846 / 3.0;

/// The six faces of a blade whose chord begins at the share `from` of the main blade's (0: a main blade, 0.4: a splitter),
/// turned about X by `angle_rad`: F1 and F3 its sides, u from the leading to the trailing edge and back; F2 the trailing,
/// F4 the leading edge, ruled across; F5 inside the hub, F6 the tip, ruled likewise. v runs from the hub outwards; F1 looks
/// towards growing angles. The sides are lofted: splines of degree 3 x 3 through 14 sections of 6 points that stand half
/// of the thickness off a twisted camber surface.
[[nodiscard]] std::vector<Face> impeller_blade(double from, double angle_rad);

/// kImpellerPairs main blades and as many splitters on a sector of the hub, one solid; faces as fuse_blisk orders them:
/// F1 to F5 the hub; of blade k = 0, 1, ... (main, splitter, main, splitter): F(6 + 4k) trailing edge, F(7 + 4k) the side
/// that looks back, F(8 + 4k) leading edge, F(9 + 4k) the side that looks forward; then the bore and the tips.
[[nodiscard]] SolidModel impeller();

}  // namespace flank::internal
