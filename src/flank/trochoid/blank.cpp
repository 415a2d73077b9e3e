#include "flank/trochoid/blank.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// The least value of a convex function on [low, high], by golden section.
template <class F>
double least(const F& f, double low, double high, double& at) {
  constexpr double kGolden = 0.6180339887498949, kNear = 1e-4;
  double x = high - kGolden * (high - low), y = low + kGolden * (high - low);
  double fx = f(x), fy = f(y);
  while (high - low > kNear) {
    if (fx <= fy) {
      high = y, y = x, fy = fx;
      x = high - kGolden * (high - low), fx = f(x);
    } else {
      low = x, x = y, fx = fy;
      y = low + kGolden * (high - low), fy = f(y);
    }
  }
  at = fx <= fy ? x : y;
  return std::min(fx, fy);
}

/// The plane that holds all points and is nearest to the place `near` along a direction: as little of the blank as possible
/// is beyond the sides. A linear programme of three unknowns, the offset and the normal's lean both ways.
HalfSpace tightest(const Vec3& direction, const Vec3& near, const std::vector<Vec3>& points) {
  constexpr double kMostLean = 1.0;  // 45 degrees
  const Vec3 e = direction.unitOrthogonal(), f = direction.cross(e);
  Eigen::Matrix3Xd at(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = points[i] - near;
    at.col(static_cast<Eigen::Index>(i)) = Vec3(direction.dot(p), e.dot(p), f.dot(p));
  }
  double a = 0.0, b = 0.0;
  const auto over_b = [&](double lean_a) {
    return least([&](double lean_b) { return (Vec3(1.0, lean_a, lean_b).transpose() * at).maxCoeff(); }, -kMostLean,
                 kMostLean, b);
  };
  (void)least(over_b, -kMostLean, kMostLean, a);
  (void)over_b(a);
  const Vec3 normal = (direction + a * e + b * f).normalized();
  HalfSpace out{normal, -std::numeric_limits<double>::infinity()};
  for (const Vec3& p : points) out.offset = std::max(out.offset, normal.dot(p));
  return out;
}

}  // namespace

std::vector<HalfSpace> cavity_blank(const std::vector<LayerSides>& layers, const Target& left, const Target& right) {
  const std::vector<Vec3> points = points_of(left, right);
  std::vector<HalfSpace> blank;
  for (const bool end : {false, true}) {
    Vec3 forward = Vec3::Zero(), middle = Vec3::Zero();
    for (const LayerSides& layer : layers) {
      for (const SidePath* path : {&layer.from, &layer.to}) {
        const AxisPlace place = path->at(end ? path->length() : 0.0);
        forward += place.velocity(0.5 * path->axis_length()).normalized();
        middle += place.at(0.5 * path->axis_length());
      }
    }
    forward *= end ? 1.0 : -1.0;
    blank.push_back(tightest(forward.normalized(), middle / (2.0 * static_cast<double>(layers.size())), points));
  }
  Vec3 up = Vec3::Zero(), tops = Vec3::Zero();
  for (const SidePath* path : {&layers.front().from, &layers.front().to}) {
    for (const double x : {0.0, path->length()}) {
      up += path->at(x).u;
      tops += 0.25 * path->at(x).at(path->axis_length());
    }
  }
  blank.push_back(tightest(up.normalized(), tops, points));
  return blank;
}

}  // namespace flank::internal
