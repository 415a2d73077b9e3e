#include "flank/geom/face_box.h"

#include <algorithm>

#include "flank/geom/face_cut.h"
#include "flank/geom/trim.h"

namespace flank::internal {
namespace {

/// A side of the patch, in one direction; nothing to cut where the trims fill the surface.
BSplineSurface cut_to(const BSplineSurface& surface, bool along_u, double first, double last, double low, double high) {
  const double spare = 2.0 * kTrimDeviation * (last - first);
  low = std::max(first, low - spare);
  high = std::min(last, high + spare);
  if (!(high > low) || (low <= first && high >= last)) return surface;
  return cut_surface(surface, along_u, low, high);
}

}  // namespace

Box3 box_of(const Face& face) {
  const BSplineSurface& whole = face.surface;
  const TrimRegion trims(face.loops, {whole.u_first(), whole.u_last(), whole.v_first(), whole.v_last()});
  const ParameterRectangle& r = trims.box();
  BSplineSurface patch = whole;
  if (!trims.whole()) {
    patch = cut_to(whole, true, whole.u_first(), whole.u_last(), r.u0, r.u1);
    patch = cut_to(patch, false, whole.v_first(), whole.v_last(), r.v0, r.v1);
  }
  Box3 box;
  for (const Vec3& pole : patch.poles) box.add(pole);
  return box;
}

bool near(const Box3& a, const Box3& b, double within_mm) {
  return (a.low.array() <= b.high.array() + within_mm).all() && (b.low.array() <= a.high.array() + within_mm).all();
}

}  // namespace flank::internal
