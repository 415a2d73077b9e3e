/// Faces that close round themselves: the skin of a vane that is one face, and the wall of a bore.
#pragma once

#include <vector>

#include "flank/feature/wheel_face.h"

namespace flank::internal {

/// How faces close round: normals every way about an axis of their own, and on which side the material is.
enum class Closing {
  kOpen,    ///< they look one way more than any other
  kRound,   ///< round material, as the skin of a vane does
  kHollow,  ///< round air, as a bore does
};
[[nodiscard]] Closing closing(const std::vector<const WheelFace*>& faces, double near_mm);

/// How large a ball is that touches one of the faces and enters none, on the side of the material or of the air: the median over the faces,
/// mm. No larger than all of them together. `near_mm`: what triangles are off their faces.
enum class Girth { kOfMaterial, kOfAir };
[[nodiscard]] double girth(const std::vector<const WheelFace*>& faces, Girth where, double near_mm);

/// Those that go on smoothly into each other and close round air: what mills a blade from outside comes to none of them.
[[nodiscard]] std::vector<const WheelFace*> hollow_faces(const std::vector<const WheelFace*>& faces, double near_mm);

}  // namespace flank::internal
