#include "flank/trochoid/blank.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

/// Points of both sides, their rims among them.
std::vector<Vec3> points_of(const Target& left, const Target& right) {
  std::vector<Vec3> points;
  for (const Target* side : {&left, &right}) {
    const double spacing = std::sqrt(side->area()) / 60.0;
    for (const SurfaceSample& sample : side->samples(spacing)) points.push_back(sample.point);
    for (const Vec3& point : side->border_points(spacing)) points.push_back(point);
  }
  return points;
}

HalfSpace support(const Vec3& normal, const std::vector<Vec3>& points) {
  HalfSpace out{normal, -std::numeric_limits<double>::infinity()};
  for (const Vec3& p : points) out.offset = std::max(out.offset, normal.dot(p));
  return out;
}

}  // namespace

std::vector<HalfSpace> cavity_blank(const LayerSides& top, const Target& left, const Target& right) {
  const std::vector<Vec3> points = points_of(left, right);
  const double middle = 0.5 * top.from.axis_length();
  std::vector<HalfSpace> blank;
  Vec3 up = Vec3::Zero();
  for (const bool end : {false, true}) {
    const AxisPlace a = top.from.at(end ? top.from.length() : 0.0), b = top.to.at(end ? top.to.length() : 0.0);
    const Vec3 forward = a.velocity(middle) + b.velocity(middle);
    Vec3 normal = (b.at(middle) - a.at(middle)).cross(a.u + b.u).normalized();
    if ((normal.dot(forward) > 0.0) != end) normal = -normal;
    blank.push_back(support(normal, points));
    up += a.u + b.u;
  }
  blank.push_back(support(up.normalized(), points));
  return blank;
}

}  // namespace flank::internal
