/// The swept distance by brute force: dense in t and s, every promising place narrowed by nested golden sections. Slow
/// and plain on purpose.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "flank/base/random.h"
#include "flank/judge.h"
#include "flank/path.h"
#include "flank/tool.h"

namespace flank::internal::brute {

template <class Function>
double golden(double a, double b, const Function& f, double* where = nullptr) {
  constexpr double kGolden = 0.6180339887498949;
  double c = b - kGolden * (b - a), d = a + kGolden * (b - a);
  double fc = f(c), fd = f(d);
  for (int i = 0; i < 60; ++i) {
    if (fc < fd) {
      b = d, d = c, fd = fc, c = b - kGolden * (b - a), fc = f(c);
    } else {
      a = c, c = d, fc = fd, d = a + kGolden * (b - a), fd = f(d);
    }
  }
  if (where != nullptr) *where = fc < fd ? c : d;
  return std::min(fc, fd);
}

/// Least value of f over [a, b]: `count` samples, then golden section around every local minimum of them within
/// `margin` of the least.
template <class Function>
double least(double a, double b, int count, double margin, const Function& f, double* where = nullptr) {
  std::vector<double> values(static_cast<std::size_t>(count + 1));
  for (int i = 0; i <= count; ++i) values[i] = f(a + (b - a) * i / count);
  const double coarse = *std::min_element(values.begin(), values.end());
  double best = 1e300;
  for (int i = 0; i <= count; ++i) {
    if (values[i] > coarse + margin) continue;
    if ((i > 0 && values[i - 1] < values[i]) || (i < count && values[i + 1] < values[i])) continue;
    const double low = a + (b - a) * std::max(0, i - 1) / count, high = a + (b - a) * std::min(count, i + 1) / count;
    double at = a + (b - a) * i / count;
    double v = golden(low, high, f, &at);
    if (values[i] < v) v = values[i], at = a + (b - a) * i / count;
    if (v < best) {
      best = v;
      if (where != nullptr) *where = at;
    }
  }
  return best;
}

inline double sphere_distance(const RadialFunction& radial, const Vec3& x, const Pose& pose, double s) {
  return (x - pose.at(s)).norm() - radial.at(s).r;
}

inline double pose_distance(const RadialFunction& radial, const Vec3& x, const Pose& pose, int steps) {
  const double length = radial.axis_length();
  return least(0.0, length, steps, 2.0 * length / steps, [&](double s) { return sphere_distance(radial, x, pose, s); });
}

inline Pose between(const Pose& p, const Pose& q, double tau) {
  return {p.tip + tau * (q.tip - p.tip), (p.axis + tau * (q.axis - p.axis)).normalized()};
}

inline double swept_distance(const Tool& tool, const Path& path, const Vec3& x, int steps_t, int steps_s) {
  struct Place {
    double value;
    const Pose *p, *q;
  };
  std::vector<Place> coarse;
  double best = 1e300;
  for (const Strip& strip : path.strips) {
    for (std::size_t i = 0; i < strip.poses.size(); ++i) {
      const Pose& p = strip.poses[i];
      const Pose& q = strip.poses[std::min(i + 1, strip.poses.size() - 1)];
      double value = 1e300;
      for (double tau : {0.0, 0.5, 1.0}) value = std::min(value, pose_distance(tool.radial, x, between(p, q, tau), 40));
      const double reach =
          std::max((q.tip - p.tip).norm(), (q.at(tool.radial.axis_length()) - p.at(tool.radial.axis_length())).norm());
      coarse.push_back({value - 0.5 * reach, &p, &q});
      best = std::min(best, value);
    }
  }
  double result = best;
  for (const Place& place : coarse) {
    if (place.value > best) continue;
    const double reach =
        (place.q->tip - place.p->tip).norm() + tool.radial.axis_length() * (place.q->axis - place.p->axis).norm();
    const auto along = [&](double tau) {
      return pose_distance(tool.radial, x, between(*place.p, *place.q, tau), steps_s);
    };
    result = std::min(result, least(0.0, 1.0, steps_t, 2.0 * reach / steps_t, along));
  }
  return result;
}

inline Vec3 random_vector(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

inline Vec3 random_unit(Random& random) {
  Vec3 v;
  do v = random_vector(random, 1.0);
  while (v.norm() > 1.0 || v.norm() < 0.1);
  return v.normalized();
}

/// A legitimate spline tool: random coefficients, calmed until the legitimacy check passes.
inline Tool random_tool(Random& random, double length) {
  const double mean = random.uniform(0.06, 0.2) * length;
  for (double swing = 0.5; swing > 1e-3; swing *= 0.7) {
    Eigen::VectorXd c(8);
    for (int i = 0; i < 8; ++i) c[i] = mean * (1.0 + swing * random.uniform(-1.0, 1.0));
    Tool tool;
    tool.radial = RadialFunction::spline(length, c);
    if (check_legitimacy(tool.radial).legitimate) return tool;
  }
  Tool tool;
  tool.radial = RadialFunction::spline(length, Eigen::VectorXd::Constant(8, mean));
  return tool;
}

/// Poses along a bent curve with an axis that turns.
inline Path twisted_path(Random& random, int poses, double travel, double turn) {
  Strip strip;
  const Vec3 start = random_vector(random, 2.0), along = random_unit(random), bend = random_unit(random);
  const Vec3 axis = random_unit(random), about = random_unit(random);
  for (int i = 0; i < poses; ++i) {
    const double t = poses > 1 ? static_cast<double>(i) / (poses - 1) : 0.0;
    Pose pose;
    pose.tip = start + travel * (t * along + 0.3 * std::sin(3.0 * t) * bend);
    pose.axis = Eigen::AngleAxisd(turn * t, about) * axis;
    strip.poses.push_back(pose);
  }
  return {{strip}};
}

}  // namespace flank::internal::brute
