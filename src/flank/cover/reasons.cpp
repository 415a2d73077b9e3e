#include "flank/cover/reasons.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

/// Pieces of the axis among whose ends the thinnest place is named.
constexpr int kRadiusPieces = 100;
/// Mean spacings: uncovered cells that are closer than this belong to one patch. Cells are not square, so their
/// diagonals may reach over sqrt(2) spacings; 2.5 also joins patches that one row of covered cells divides, which read
/// as one gap.
constexpr double kPatchReach = 2.5;

/// s, to a hundredth of the axis, of the smallest radius: enough to find the place, the radius itself is exact.
double thinnest_at(const RadialFunction& radial) {
  double at = 0.0, least = radial.at(0.0).r;
  for (int j = 1; j <= kRadiusPieces; ++j) {
    const double s = radial.axis_length() * j / double(kRadiusPieces), r = radial.at(s).r;
    if (r >= least) continue;
    at = s;
    least = r;
  }
  return at;
}

std::vector<char> covered_cells(const CoverSamples& samples, const std::vector<CoverStrip>& strips) {
  std::vector<char> covered(samples.cells.size(), 0);
  for (const CoverStrip& strip : strips)
    for (const int k : strip.cells) covered[static_cast<std::size_t>(k)] = 1;
  return covered;
}

/// The largest connected patch of uncovered samples: its area and its middle (the mean of its samples).
std::pair<double, Vec3> largest_gap(const CoverSamples& samples, const std::vector<CoverStrip>& strips) {
  std::vector<char> covered = covered_cells(samples, strips);
  const double reach =
      kPatchReach * std::sqrt(samples.area / static_cast<double>(std::max<std::size_t>(1, samples.cells.size())));
  std::pair<double, Vec3> largest{0.0, Vec3::Zero()};
  for (std::size_t first = 0; first < samples.cells.size(); ++first) {
    if (covered[first] != 0) continue;
    std::vector<std::size_t> patch = {first};
    covered[first] = 1;
    double area = 0.0;
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < patch.size(); ++i) {
      const SurfaceSample& cell = samples.cells[patch[i]];
      area += cell.area;
      sum += cell.area * cell.point;
      for (std::size_t k = 0; k < samples.cells.size(); ++k) {
        if (covered[k] != 0 || (samples.cells[k].point - cell.point).squaredNorm() > reach * reach) continue;
        covered[k] = 1;
        patch.push_back(k);
      }
    }
    if (area > largest.first) largest = {area, sum / area};
  }
  return largest;
}

}  // namespace

ConcavePlace most_concave(const Target& target, const CoverSamples& samples, const std::vector<CoverStrip>& strips) {
  const std::vector<char> covered = covered_cells(samples, strips);
  ConcavePlace place;
  for (std::size_t k = 0; k < covered.size(); ++k) {
    if (covered[k] != 0) continue;
    const SurfaceSample& cell = samples.cells[k];
    const Footpoint foot = target.closest(cell.point);
    if (foot.k2 <= place.curvature) continue;
    place = {foot.k2, cell.point};
  }
  return place;
}

std::string reason_of(const Target& target, const RadialFunction& radial, const CoverSamples& samples,
                      const std::vector<CoverStrip>& strips, double tolerance_mm) {
  // The hollow first: if it is too tight, no path can help, and every other reason would only follow from it.
  const ConcavePlace concave = most_concave(target, samples, strips);
  const double thinnest = radial.smallest();
  if (thinnest * concave.curvature > 1.0)
    return fmt::format(
        "the concave face needs a tool radius below {:.3g} mm at ({:.1f}, {:.1f}, {:.1f}); the smallest of this tool "
        "is {:.3g} mm, {:.3g} mm along its axis",
        1.0 / concave.curvature, concave.point.x(), concave.point.y(), concave.point.z(), thinnest,
        thinnest_at(radial));
  if (strips.empty())
    return fmt::format(
        "nowhere does the whole flank ({:.3g} mm) lie within {:.3g} mm of the face; use a shorter tool, or one whose "
        "profile curvature matches the face",
        radial.axis_length(), tolerance_mm);
  const auto [area, middle] = largest_gap(samples, strips);
  if (area == 0.0) return "";
  return fmt::format("the largest unfinished area is {:.3g} mm2 near ({:.1f}, {:.1f}, {:.1f})", area, middle.x(),
                     middle.y(), middle.z());
}

}  // namespace flank::internal
