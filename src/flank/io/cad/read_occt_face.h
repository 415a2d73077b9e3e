/// An Open CASCADE face as values. Private to io: no Open CASCADE type leaves this folder.
#pragma once

#include <TopoDS_Face.hxx>
#include <string>
#include <vector>

#include "flank/face.h"
#include "flank/io/cad/read_occt_surface.h"

namespace flank::internal {

struct OcctFace {
  Face face;         ///< id, solid and of_solid are not set
  std::string type;  ///< plane, cylinder, cone, sphere, torus, Bezier, B-spline, revolution, extrusion, offset, other
  ParameterMap map_u, map_v;
  std::vector<std::string> notes;
};

/// Converts surface and trims. `name` (file and face) begins every message. Throws InputError for a face without a
/// finite surface or with trims that cannot be had.
[[nodiscard]] OcctFace convert_occt_face(const TopoDS_Face& face, const std::string& name);

}  // namespace flank::internal
