#include "flank/ruled_motion.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "flank/base/assert.h"
#include "flank/error.h"
#include "flank/motion/rail_bounds.h"

namespace flank {
using namespace internal;

Pose RuledMotion::pose(double t) const { return {tip.value(t), direction.value(t).normalized()}; }

AxisJet RuledMotion::jet(double t) const {
  const CurveJet<3> a = tip.jet(t), w = direction.jet(t);
  AxisJet axis;
  axis.tip = a.p;
  axis.tip_d1 = a.d1;
  const double length = w.p.norm();
  axis.u = w.p / length;
  // u' is the part of w' across u: the rest only changes the length of w.
  axis.u_d1 = (w.d1 - w.d1.dot(axis.u) * axis.u) / length;
  return axis;
}

RuledMotion fit_motion(const std::vector<Pose>& poses, const std::vector<double>& t, double axis_length, int count) {
  FLANK_ASSERT(axis_length > 0.0);
  if (poses.size() != t.size()) throw InternalError("fit_motion needs one time t for every CL point");
  if (count < 4 || static_cast<int>(poses.size()) < count)
    throw InternalError("fit_motion needs at least 4 control points and at least as many poses, got " +
                        std::to_string(count) + " and " + std::to_string(poses.size()));
  Eigen::Matrix3Xd tips(3, poses.size()), directions(3, poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    tips.col(i) = poses[i].tip;
    directions.col(i) = poses[i].axis.normalized();
  }
  return {axis_length, fit_curve(tips, t, 3, count), fit_curve(directions, t, 3, count)};
}

namespace {

/// No motion on a part needs more: past it the bound is of no use and the steps are made equal.
constexpr double kHopelessToleranceMm = 1e6;

/// The bound goes with the square of the step. kSafe keeps the next try from failing by round-off; kShortest keeps one
/// bad bound (infinite while the direction turns too far) from making the step vanish at once.
constexpr double kSafe = 0.98, kShortest = 0.1;
constexpr double kNoStep = 1e-12;  ///< of t: so short a step means that no step has a bound
constexpr double kLonger = 1.25;   ///< how much longer the next step is tried than the last one was
constexpr double kSliver = 1e-9;   ///< of what is left of t: no step of its own
constexpr double kGiveWay = 1.5;   ///< of the tolerance, when the poses run out: a fifth fewer poses each time

/// Bounds how far the joined poses leave the motion over one step.
///
/// Joined poses at share x of a step: tip (1-x) a0 + x a1, axis the normalised m = (1-x) u0 + x u1. Linear
/// interpolation over a step h is off by at most h^2/8 max|f''|. With n <= |w| on the step, u = w/|w| has |u'| <=
/// |w'|/n =: b and |u''| <= sqrt((|w''|/n + b^2)^2 + b^4): the part across u and the part along it. Scaling to the ball
/// of radius |m| does not expand, so |m/|m| - u| <= |m - u| / |m|, and |m| >= sqrt(1 - |u1 - u0|^2/4).
class ChordBound {
 public:
  explicit ChordBound(const RuledMotion& motion)
      : motion_(motion),
        tip_d2_(derivative(derivative(motion.tip))),
        direction_d1_(derivative(motion.direction)),
        direction_d2_(derivative(direction_d1_)) {}

  /// The larger of the bounds at s = 0 and s = L, which bounds every s between; infinity if none can be given.
  [[nodiscard]] double over(double t0, double t1) const {
    const double factor = (t1 - t0) * (t1 - t0) / 8.0;
    const Vec3 middle = motion_.direction.value(0.5 * (t0 + t1)).normalized();
    const double n = smallest_component(motion_.direction, middle, t0, t1);
    const Vec3 u0 = motion_.direction.value(t0).normalized(), u1 = motion_.direction.value(t1).normalized();
    const double m2 = 1.0 - (u1 - u0).squaredNorm() / 4.0;
    if (!(n > 0.0) || !(m2 > 0.0)) return std::numeric_limits<double>::infinity();
    const double b2 = std::pow(largest_norm(direction_d1_, t0, t1) / n, 2);
    const double u_d2 = std::hypot(largest_norm(direction_d2_, t0, t1) / n + b2, b2);
    return factor * (largest_norm(tip_d2_, t0, t1) + motion_.axis_length * u_d2 / std::sqrt(m2));
  }

 private:
  const RuledMotion& motion_;
  BSplineCurve3 tip_d2_, direction_d1_, direction_d2_;
};

/// Shortens `step` until the bound over it is within the tolerance.
double accepted_step(const ChordBound& bound, double t, double step, double tolerance_mm) {
  for (;;) {
    const double b = bound.over(t, t + step);
    if (b <= tolerance_mm) return step;
    step *= std::clamp(kSafe * std::sqrt(tolerance_mm / b), kShortest, kSafe);
    if (step < kNoStep) throw InternalError("the tool axis has no direction near t = " + std::to_string(t));
  }
}

/// Parameters by steps as long as the tolerance lets them be; stops early when there are more than `most`.
std::vector<double> march(const ChordBound& bound, double tolerance_mm, double largest_step, int most) {
  std::vector<double> t{0.0};
  double step = largest_step;
  while (t.back() < 1.0 && static_cast<int>(t.size()) <= most) {
    const double rest = 1.0 - t.back();
    step = std::min({kLonger * step, largest_step, rest});
    if (rest - step < kSliver * rest) step = rest;
    step = accepted_step(bound, t.back(), step, tolerance_mm);
    // Two equal last steps instead of a long one and a sliver.
    if (step < rest && rest < 2.0 * step) step = 0.5 * rest;
    t.push_back(step == rest ? 1.0 : t.back() + step);
  }
  return t;
}

/// Halves the steps over which the path of the tip, the middle or the end of the axis turns too far.
std::vector<double> with_turns(const RuledMotion& motion, const SamplingOptions& options,
                               const std::vector<double>& t) {
  constexpr int kHalvings = 10;  // of a step: a path that still turns has a cusp there
  std::vector<double> out{t.front()};
  const auto turns = [&](const AxisJet& from, const AxisJet& to) {
    for (const double share : {0.0, 0.5, 1.0}) {
      const double s = share * motion.axis_length;
      if ((to.at(s) - from.at(s)).norm() <= options.chord_tolerance_mm) continue;
      const Vec3 a = from.velocity(s), b = to.velocity(s);
      if (std::atan2(a.cross(b).norm(), a.dot(b)) > options.largest_turn_rad) return true;
    }
    return false;
  };
  const auto add = [&](const auto& self, double t0, double t1, int depth) -> void {
    if (depth < kHalvings && turns(motion.jet(t0), motion.jet(t1))) {
      const double middle = 0.5 * (t0 + t1);
      self(self, t0, middle, depth + 1);
      self(self, middle, t1, depth + 1);
      return;
    }
    out.push_back(t1);
  };
  for (std::size_t i = 1; i < t.size(); ++i) add(add, t[i - 1], t[i], 0);
  return out;
}

std::vector<double> equal_steps(int count) {
  std::vector<double> t(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) t[static_cast<std::size_t>(i)] = static_cast<double>(i) / (count - 1);
  return t;
}

void check(const RuledMotion& motion, const SamplingOptions& options) {
  if (!(options.chord_tolerance_mm > 0.0))
    throw UsageError("the chord tolerance must be positive, got " + std::to_string(options.chord_tolerance_mm) + " mm");
  if (options.minimum_poses < 2 || options.maximum_poses < options.minimum_poses)
    throw UsageError("minimum_poses must be at least 2, and maximum_poses not below it");
  if (motion.tip.degree < 2 || motion.direction.degree < 2 || !motion.tip.weights.empty() ||
      !motion.direction.weights.empty())
    throw InternalError("sample_motion needs curves of tip and direction without weights, of degree 2 or more");
}

}  // namespace

SampledMotion sample_motion(const RuledMotion& motion, const SamplingOptions& options) {
  check(motion, options);
  const ChordBound bound(motion);
  const double largest_step = 1.0 / (options.minimum_poses - 1);
  double tolerance_mm = options.chord_tolerance_mm;
  std::vector<double> t = march(bound, tolerance_mm, largest_step, options.maximum_poses);
  // Too many poses: the tolerance gives way and chord_bound_mm says what was reached.
  while (static_cast<int>(t.size()) > options.maximum_poses && tolerance_mm < kHopelessToleranceMm) {
    tolerance_mm *= kGiveWay;
    t = march(bound, tolerance_mm, largest_step, options.maximum_poses);
  }
  if (static_cast<int>(t.size()) > options.maximum_poses) t = equal_steps(options.maximum_poses);
  if (options.largest_turn_rad < 1e300) {
    std::vector<double> finer = with_turns(motion, options, t);
    if (static_cast<int>(finer.size()) <= options.maximum_poses) t = std::move(finer);
  }
  SampledMotion out;
  out.t = std::move(t);
  out.poses.reserve(out.t.size());
  for (const double x : out.t) out.poses.push_back(motion.pose(x));
  for (std::size_t i = 1; i < out.t.size(); ++i)
    out.chord_bound_mm = std::max(out.chord_bound_mm, bound.over(out.t[i - 1], out.t[i]));
  return out;
}

}  // namespace flank
