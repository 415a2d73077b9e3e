#include "flank/geom/face_box.h"

#include <algorithm>
#include <limits>

#include "flank/geom/face_cut.h"
#include "flank/geom/trim.h"

namespace flank::internal {
namespace {

/// Between two parameters of a direction; the whole where they reach past both ends.
BSplineSurface cut_to(const BSplineSurface& surface, bool along_u, double low, double high) {
  const double first = along_u ? surface.u_first() : surface.v_first();
  const double last = along_u ? surface.u_last() : surface.v_last();
  const double spare = kTrimDeviation * (last - first);
  low = std::max(first, low - spare);
  high = std::min(last, high + spare);
  if (!(high > low) || (low <= first && high >= last)) return surface;
  return cut_surface(surface, along_u, low, high);
}

}  // namespace

Box3 box_of(const Face& face) {
  BSplineSurface patch = face.surface;
  if (!face.loops.empty()) {
    // A curve lies in the hull of its control points, and so do the straight lines that join the ends of curves.
    Vec2 low = Vec2::Constant(std::numeric_limits<double>::max()), high = -low;
    for (const TrimLoop& loop : face.loops)
      for (const BSplineCurve2& edge : loop.edges) {
        low = low.cwiseMin(edge.poles.rowwise().minCoeff());
        high = high.cwiseMax(edge.poles.rowwise().maxCoeff());
      }
    patch = cut_to(cut_to(patch, true, low.x(), high.x()), false, low.y(), high.y());
  }
  Box3 box;
  for (const Vec3& pole : patch.poles) box.add(pole);
  return box;
}

bool near(const Box3& a, const Box3& b, double within_mm) {
  return (a.low.array() <= b.high.array() + within_mm).all() && (b.low.array() <= a.high.array() + within_mm).all();
}

}  // namespace flank::internal
