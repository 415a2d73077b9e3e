#include "flank/setup/fillet.h"

#include <algorithm>
#include <cmath>

#include "flank/setup/joints.h"

namespace flank::internal {
namespace {

constexpr double kAlongShare = 0.25;  ///< of the width of the target: what it is joined along; less is a corner
constexpr double kAlike = 1.5;        ///< ratio of radii, of the middle half of the border

/// The radius of a face that bends outwards all along its border, with about one radius.
std::optional<double> radius_of_fillet(const std::vector<FaceEdge>& border) {
  std::vector<double> bends;
  for (const FaceEdge& edge : border)
    for (const EdgePoint& point : edge.points)
      if (std::isfinite(point.bend)) bends.push_back(point.bend);
  if (bends.empty()) return {};
  std::sort(bends.begin(), bends.end());
  const double low = bends[bends.size() / 4], middle = bends[bends.size() / 2], high = bends[3 * bends.size() / 4];
  if (low <= 0.0 || high > kAlike * low) return {};
  return 1.0 / middle;
}

}  // namespace

std::optional<double> tightest_fillet(const Part& part, const std::vector<int>& faces, double below_mm) {
  const auto of_solid = [&](int face) { return part.faces[static_cast<std::size_t>(face)].of_solid; };
  // To look at the borders of a large part takes a tenth of a second.
  if (part.is_mesh() || std::none_of(faces.begin(), faces.end(), of_solid)) return {};
  Joints joints(part);
  std::optional<double> tightest;
  for (const int face : faces) {
    const Face& own = part.faces[static_cast<std::size_t>(face)];
    for (int other = 0; other < part.face_count(); ++other) {
      const Face& its = part.faces[static_cast<std::size_t>(other)];
      if (std::find(faces.begin(), faces.end(), other) != faces.end() || !its.of_solid || !own.of_solid ||
          its.solid != own.solid)
        continue;
      const std::optional<double> radius = radius_of_fillet(joints.border(other));
      if (!radius || *radius >= tightest.value_or(below_mm) || !joints.borders_meet(face, other)) continue;
      if (joints.joined_mm(face, other) >= kAlongShare * std::sqrt(joints.target(face).area())) tightest = radius;
    }
  }
  return tightest;
}

}  // namespace flank::internal
