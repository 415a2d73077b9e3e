/// NASA Rotor 37, made from its published coordinates: a real compressor blade, and two of them on part of their hub.
#pragma once

#include <vector>

#include "flank/face.h"
#include "flank/io/cad/write_solid.h"

namespace flank::internal {

/// Where the blade begins: at the first published section, which runs along the hub, or inside the hub, below the first
/// section by a quarter of the step to the second (1.7 mm).
enum class Rotor37Root { kAtTheHub, kInsideTheHub };

/// The six faces of the blade; their normals point outward (F5 is reversed). F1 is side 1, u from the leading to the
/// trailing edge, F3 is side 2, u back again; F2 is the trailing and F4 the leading edge; v runs from the hub to the
/// shroud. F5 closes the blade at the hub, F6 at the shroud. The splines of degree 3 x 3 go through 36 stations of each
/// section on a side and 9 points at an edge, to 1e-9 mm; the stations between them lie within 0.14 mm.
[[nodiscard]] std::vector<Face> rotor37_faces(Rotor37Root root = Rotor37Root::kAtTheHub);

/// The blade as a solid, faces as above: 42.8 x 74.4 x 48.4 mm.
[[nodiscard]] SolidModel rotor37_blade();

/// Angle about the X axis between the two blades of the blisk, as between the 36 of the rotor.
inline constexpr double kRotor37PitchRad = 10.0 * 3.14159265358979323846 / 180.0;
inline constexpr int kRotor37Blades = 36;  ///< of the rotor
inline constexpr int kRotor37MostOfPiece =
    33;  ///< blades: a piece of the hub has cuts, which more would bring to overlap

/// 49 degrees of the hub with two blades, no fillets, one solid of 16 faces: F1 the hub's skin; F2, F5 its front and
/// back; F3, F4 its cuts; F14 its bore; F9, F6, F7, F8 are F1 to F4 of the blade where it was published, F13, F10, F11,
/// F12 those of the next; F15, F16 their tips. The cavity lies between F9 and F11. With more blades the hub is a pitch longer for each,
/// and their faces follow those of the second; with kRotor37Blades it goes all round, and has no cuts.
[[nodiscard]] SolidModel rotor37_blisk(int blades = 2);

}  // namespace flank::internal
