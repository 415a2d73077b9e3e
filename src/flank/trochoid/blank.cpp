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

/// Along the axes at both ends, less what leans along the way: ends that lean as the axis does a lower layer may never leave.
Vec3 upwards(const LayerSides& sides) {
  const double middle = 0.5 * sides.from.axis_length();
  Vec3 up = Vec3::Zero(), along = Vec3::Zero();
  for (const SidePath* path : {&sides.from, &sides.to}) {
    const AxisPlace first = path->at(0.0), last = path->at(path->length());
    up += first.u + last.u;
    along += last.at(middle) - first.at(middle);
  }
  along.normalize();
  return (up - up.dot(along) * along).normalized();
}

}  // namespace

std::vector<HalfSpace> cavity_blank(const LayerSides& top, const Target& left, const Target& right) {
  const std::vector<Vec3> points = points_of(left, right);
  const double middle = 0.5 * top.from.axis_length();
  std::vector<HalfSpace> blank;
  const Vec3 up = upwards(top);
  for (const bool end : {false, true}) {
    const AxisPlace a = top.from.at(end ? top.from.length() : 0.0), b = top.to.at(end ? top.to.length() : 0.0);
    const Vec3 forward = a.velocity(middle) + b.velocity(middle);
    Vec3 normal = (b.at(middle) - a.at(middle)).cross(up).normalized();
    if ((normal.dot(forward) > 0.0) != end) normal = -normal;
    blank.push_back(support(normal, points));
  }
  blank.push_back(support(up, points));
  return blank;
}

}  // namespace flank::internal
