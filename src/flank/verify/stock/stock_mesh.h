/// The surface of a tri-dexel stock as triangles: what is left, to look at.
#pragma once

#include "flank/triangle_mesh.h"
#include "flank/verify/stock/dexel_stock.h"

namespace flank::internal::verify {

/// Closed, counter-clockwise seen from outside. A vertex is the mean of where the lines around it end. `stride` (>= 1): of
/// so many lines one counts, in each direction.
[[nodiscard]] TriangleMesh stock_mesh(const DexelStock& stock, int stride = 1);

/// The least stride with which there are no more than about so many triangles.
[[nodiscard]] int stride_for(const DexelStock& stock, double most_triangles);

}  // namespace flank::internal::verify
