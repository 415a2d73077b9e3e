/// Continues a mesh's surface past its borders and across its holes.
#pragma once

#include <vector>

#include "flank/surface/mesh/mesh_surface.h"
#include "flank/target.h"

namespace flank::internal {

/// Appends triangles and jets to `surface` (MATH: section 4). Along each rim, rows of triangles out to length_share
/// times the mesh's extent behind that border; across each hole (a loop that turns by about -2 pi), rings towards its
/// centre. Their jets follow the border's own jets at first and, farther out, a cubic fitted to the outer fit_share of
/// the mesh (a hole: to its surroundings), shifted to meet the border. Rows that would fold over (a border bent more
/// tightly than the extension is long) are left out. `normals`: of the real vertices.
void extend(JetSurface& surface, const std::vector<Vec3>& normals, const ExtensionOptions& options);

}  // namespace flank::internal
