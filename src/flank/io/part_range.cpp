#include "flank/io/part_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flank/error.h"

namespace flank::internal {
namespace {

bool finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

bool finite(const BSplineSurface& s) {
  return finite(s.knots_u) && finite(s.knots_v) && finite(s.weights) &&
         std::all_of(s.poles.begin(), s.poles.end(), [](const Vec3& p) { return p.allFinite(); });
}

bool finite(const Face& face) {
  for (const TrimLoop& loop : face.loops)
    for (const BSplineCurve2& edge : loop.edges)
      if (!finite(edge.knots) || !finite(edge.weights) || !edge.poles.allFinite()) return false;
  return finite(face.surface);
}

}  // namespace

void require_part_in_range(const Part& part) {
  for (const Face& face : part.faces)
    if (!finite(face))
      throw InputError(
          fmt::format("{}, face {}: has numbers that are not finite; export the part again", part.file, face.id));
  const bool some = (part.box.low.array() <= part.box.high.array()).all();
  if (!some || !part.box.low.allFinite() || !part.box.high.allFinite())
    throw InputError(part.file + ": has no finite extent; export the part again");
  const double reach = std::max(part.box.low.cwiseAbs().maxCoeff(), part.box.high.cwiseAbs().maxCoeff());
  if (reach > kLargestCoordinateMm)
    throw InputError(
        fmt::format("{}: reaches to {:.3g} mm; expected coordinates up to {:g} mm: is its unit ({}) right?", part.file,
                    reach, kLargestCoordinateMm, part.unit));
  if (part.box.diagonal() < kSmallestBoxMm)
    throw InputError(fmt::format("{}: is {:.3g} mm across; expected at least {:g} mm: is its unit ({}) right?",
                                 part.file, part.box.diagonal(), kSmallestBoxMm, part.unit));
}

}  // namespace flank::internal
