#include "flank/tour/legs.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/error.h"

namespace flank::internal {
namespace {

constexpr double kNoWayMm = 1e-7;

/// A cubic in Bezier's form, of both rails.
struct Cubic {
  std::array<Vec3, 4> tip, direction;
};

/// Through four points at 0, 1/3, 2/3 and 1.
std::array<Vec3, 4> through(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return {a, (-5.0 * a + 18.0 * b - 9.0 * c + 2.0 * d) / 6.0, (2.0 * a - 9.0 * b + 18.0 * c - 5.0 * d) / 6.0, d};
}

Vec3 value(const std::array<Vec3, 4>& p, double t) {
  const double s = 1.0 - t;
  return s * s * s * p[0] + 3.0 * s * s * t * p[1] + 3.0 * s * t * t * p[2] + t * t * t * p[3];
}

Cubic cubic_of(const Leg& leg, double from, double to) {
  std::array<Pose, 4> poses;
  for (int k = 0; k < 4; ++k) poses[k] = leg(from + (to - from) * k / 3.0);
  return {through(poses[0].tip, poses[1].tip, poses[2].tip, poses[3].tip),
          through(poses[0].axis, poses[1].axis, poses[2].axis, poses[3].axis)};
}

double distance(const Pose& a, const Pose& b, double length) {
  return std::max((a.tip - b.tip).norm(), (a.at(length) - b.at(length)).norm());
}

/// Halves the steps of a leg until its cubics follow it.
std::vector<Cubic> cubics_of(const Leg& leg, double length, double off_mm) {
  constexpr int kMost = 512;
  std::vector<Cubic> cubics;
  for (int count = 1; count <= kMost; count *= 2) {
    cubics.clear();
    double off = 0.0;
    for (int k = 0; k < count; ++k) {
      const double from = static_cast<double>(k) / count, to = (k + 1.0) / count;
      cubics.push_back(cubic_of(leg, from, to));
      for (const double t : {1.0 / 6.0, 0.5, 5.0 / 6.0}) {
        const Pose there{value(cubics.back().tip, t), value(cubics.back().direction, t).normalized()};
        off = std::max(off, distance(there, leg(from + t * (to - from)), length));
      }
    }
    if (off <= off_mm) break;
  }
  return cubics;
}

/// Cubics end to end: every knot between them is threefold.
BSplineCurve3 rail(const std::vector<std::array<Vec3, 4>>& cubics, const std::vector<double>& times) {
  BSplineCurve3 curve;
  curve.degree = 3;
  const auto count = static_cast<Eigen::Index>(cubics.size());
  curve.poles.resize(3, 3 * count + 1);
  curve.knots.assign(4, 0.0);
  for (Eigen::Index k = 0; k < count; ++k) {
    for (Eigen::Index j = 0; j < 3; ++j)
      curve.poles.col(3 * k + j) = cubics[static_cast<std::size_t>(k)][static_cast<std::size_t>(j)];
    curve.knots.insert(curve.knots.end(), k + 1 < count ? 3 : 4, times[static_cast<std::size_t>(k + 1)]);
  }
  curve.poles.col(3 * count) = cubics.back()[3];
  return curve;
}

}  // namespace

double way_of(const Leg& leg, double axis_length_mm) {
  constexpr int kSteps = 12;
  double way = 0.0;
  Pose before = leg(0.0);
  for (int k = 1; k <= kSteps; ++k) {
    const Pose here = leg(static_cast<double>(k) / kSteps);
    way += distance(before, here, axis_length_mm) + axis_length_mm * (here.axis - before.axis).norm();
    before = here;
  }
  return way;
}

RuledMotion motion_through(const std::vector<Leg>& legs, double axis_length_mm, double off_mm) {
  std::vector<std::array<Vec3, 4>> tips, directions;
  std::vector<double> times{0.0};
  for (const Leg& leg : legs) {
    const double way = way_of(leg, axis_length_mm);
    if (way <= kNoWayMm) continue;
    const std::vector<Cubic> cubics = cubics_of(leg, axis_length_mm, off_mm);
    const double begin = times.back();
    for (std::size_t k = 0; k < cubics.size(); ++k) {
      tips.push_back(cubics[k].tip);
      directions.push_back(cubics[k].direction);
      times.push_back(begin + way * static_cast<double>(k + 1) / static_cast<double>(cubics.size()));
    }
  }
  if (tips.empty()) throw InternalError("a motion needs a path of some length");
  const double whole = times.back();
  for (double& time : times) time /= whole;
  times.back() = 1.0;
  return {axis_length_mm, rail(tips, times), rail(directions, times)};
}

}  // namespace flank::internal
