#include "flank/verify/stock/line_weights.h"

#include <algorithm>
#include <cmath>

namespace flank::internal::verify {
namespace {

/// A plane that crosses more lines than so many in the box ends them where it does, and they differ enough.
constexpr double kMostCrossed = 4.0;

}  // namespace

LineWeights::LineWeights(const DexelField& field, const Box3& box, const std::vector<HalfSpace>& planes,
                         double cell_mm) {
  const int axis = field.axis();
  for (const HalfSpace& plane : planes) {
    const Vec3& n = plane.normal;
    const double square = std::max(std::abs(n[field.across()]), std::abs(n[field.up()])),
                 unit = 1.0 / (square * cell_mm);
    if (std::abs(n[axis]) * (box.high - box.low)[axis] > kMostCrossed * square * cell_mm) continue;
    edges_.push_back({plane.offset * unit, n[axis] * unit, n[field.across()] * unit, n[field.up()] * unit});
  }
}

}  // namespace flank::internal::verify
