#include "flank/trochoid/paths/side_path.h"

#include <algorithm>
#include <cmath>

#include "flank/motion/motion_part.h"

namespace flank::internal {
namespace {

constexpr int kSteps = 512;

/// The curve run through backwards; knots over [0, 1].
BSplineCurve3 backwards_of(const BSplineCurve3& curve) {
  BSplineCurve3 out = curve;
  out.poles = curve.poles.rowwise().reverse();
  std::reverse(out.knots.begin(), out.knots.end());
  for (double& k : out.knots) k = 1.0 - k;
  return out;
}

/// A slope that grows evenly from 0 to 1 over a length, and what it has risen.
struct Slope {
  double slope = 0.0, risen = 0.0;
};

Slope slope_after(double by, double over) {
  if (by <= 0.0) return {};
  const double grown = std::min(by, over);
  return {grown / over, 0.5 * grown * grown / over + by - grown};
}

}  // namespace

SidePath::SidePath(RuledMotion motion, bool backwards) : motion_(std::move(motion)) {
  if (backwards) {
    motion_.tip = backwards_of(motion_.tip);
    motion_.direction = backwards_of(motion_.direction);
  }
  way_.assign(1, 0.0);
  Vec3 before = motion_.pose(0.0).at(0.5 * motion_.axis_length);
  for (int k = 1; k <= kSteps; ++k) {
    const Vec3 now = motion_.pose(static_cast<double>(k) / kSteps).at(0.5 * motion_.axis_length);
    way_.push_back(way_.back() + (now - before).norm());
    before = now;
  }
  const double middle = 0.5 * motion_.axis_length;
  const Vec3 first = inside(0.0).velocity(middle), last = inside(1.0).velocity(middle);
  before_.from = before_.to = first;
  after_.from = after_.to = last;
}

AxisPlace SidePath::inside(double t) const {
  const AxisJet jet = motion_.jet(t);
  const double speed = jet.velocity(0.5 * motion_.axis_length).norm();
  return {jet.tip, jet.u, jet.tip_d1 / speed, jet.u_d1 / speed};
}

double SidePath::time_of(double x) const {
  const auto after = std::upper_bound(way_.begin() + 1, way_.end() - 1, x);
  const auto k = static_cast<std::size_t>(after - way_.begin());
  const double share = (x - way_[k - 1]) / (way_[k] - way_[k - 1]);
  return (static_cast<double>(k) - 1.0 + share) / kSteps;
}

RuledMotion SidePath::motion_between(double from, double to) const {
  if (from <= 0.0 && to >= length()) return motion_;
  const double start = from <= 0.0 ? 0.0 : time_of(from), end = to >= length() ? 1.0 : time_of(to);
  return motion_part(motion_, start, end);
}

RuledMotion SidePath::run_out_between(double from, double to) const {
  constexpr int kPoses = 49, kSpans = 16;
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int k = 0; k < kPoses; ++k) {
    t.push_back(k / (kPoses - 1.0));
    const AxisPlace place = at(std::lerp(from, to, t.back()));
    poses.push_back({place.tip, place.u});
  }
  return fit_motion(poses, t, motion_.axis_length, kSpans);
}

std::vector<RuledMotion> SidePath::motions_between(double from, double to) const {
  std::vector<RuledMotion> out;
  from = std::max(from, first()), to = std::min(to, last());
  if (from < 0.0) out.push_back(run_out_between(from, std::min(to, 0.0)));
  if (to > 0.0 && from < length()) out.push_back(motion_between(from, to));
  if (to > length()) out.push_back(run_out_between(std::max(from, length()), to));
  return out;
}

AxisPlace SidePath::at(double x) const {
  x = std::clamp(x, first(), last());
  if (x >= 0.0 && x <= length()) return inside(time_of(x));
  const AxisPlace end = inside(x < 0.0 ? 0.0 : 1.0);
  const RunOut& out = x < 0.0 ? before_ : after_;
  const double by = x < 0.0 ? -x : x - length(), sign = x < 0.0 ? -1.0 : 1.0;
  const Slope bent = slope_after(by, out.over_mm), rise = slope_after(by, out.rise_over_mm),
              fall = slope_after(by - out.rise_until_mm, out.rise_over_mm);
  const Vec3 turn = out.to - out.from;
  const Vec3 way = by * out.from + bent.risen * turn;
  const Vec3 up = (rise.risen - fall.risen) * out.rise;
  AxisPlace place{end.tip + sign * way + up, end.u,
                  out.from + bent.slope * turn + sign * (rise.slope - fall.slope) * out.rise, Vec3::Zero()};
  if (out.axis) turn_axis(out, by, sign, place);
  return place;
}

void SidePath::turn_axis(const RunOut& out, double by, double sign, AxisPlace& place) const {
  const double x = std::min(by / out.turn_over_mm, 1.0);
  const double share = x * x * (3.0 - 2.0 * x), share_dx = sign * 6.0 * x * (1.0 - x) / out.turn_over_mm;
  const double angle = std::acos(std::clamp(place.u.dot(*out.axis), -1.0, 1.0));
  const Vec3 across = *out.axis - place.u.dot(*out.axis) * place.u;
  if (!(across.norm() > 0.0)) return;
  const Vec3 side = across.normalized();
  const double middle = 0.5 * motion_.axis_length;
  const Vec3 u = std::cos(share * angle) * place.u + std::sin(share * angle) * side;
  place.u_dx = share_dx * angle * (std::cos(share * angle) * side - std::sin(share * angle) * place.u);
  place.tip += middle * (place.u - u);
  place.tip_dx -= middle * place.u_dx;
  place.u = u;
}

void SidePath::bend_run_out(bool at_end, const Vec3& direction, double over_mm) {
  RunOut& out = at_end ? after_ : before_;
  out.to = direction;
  out.over_mm = over_mm;
}

void SidePath::raise_run_out(bool at_end, const Vec3& rise, double over_mm, double until_mm) {
  RunOut& out = at_end ? after_ : before_;
  out.rise = rise;
  out.rise_over_mm = over_mm;
  out.rise_until_mm = until_mm;
}

void SidePath::turn_run_out(bool at_end, const std::optional<Vec3>& axis, double over_mm) {
  RunOut& out = at_end ? after_ : before_;
  out.axis = axis;
  out.turn_over_mm = over_mm;
}

double SidePath::step_of(const RunOut& out, double chord_mm) const {
  double curvature = (out.to - out.from).norm() / out.over_mm + out.rise.norm() / out.rise_over_mm;
  if (out.axis) {
    const Vec3 u = inside(&out == &before_ ? 0.0 : 1.0).u;
    const double angle = std::acos(std::clamp(u.dot(*out.axis), -1.0, 1.0));
    // Of the axis' ends, about its middle: the second derivative of a smooth step is at most six.
    curvature += 6.0 * angle / (out.turn_over_mm * out.turn_over_mm) * 0.5 * motion_.axis_length;
  }
  return std::sqrt(8.0 * chord_mm / curvature);
}

std::vector<Pose> SidePath::poses(double from, double to, double chord_mm) const {
  SamplingOptions options;
  options.chord_tolerance_mm = chord_mm;
  const SampledMotion sampled = sample_motion(motion_, options);
  std::vector<Pose> out;
  const auto add = [&](double x) {
    const AxisPlace place = at(x);
    out.push_back({place.tip, place.u});
  };
  const auto add_between = [&](const RunOut& run_out, double first, double last) {
    constexpr double kMost = 500.0;
    const double count = std::min(kMost, std::ceil((last - first) / step_of(run_out, chord_mm)));
    for (int k = 1; k < count; ++k) add(first + (last - first) * k / count);
  };
  if (from < 0.0) add(from);
  if (from < 0.0 && first() < 0.0) add_between(before_, std::max(from, first()), std::min(to, 0.0));
  for (std::size_t k = 0; k < sampled.poses.size(); ++k) {
    const double x = way_[static_cast<std::size_t>(std::lround(sampled.t[k] * kSteps))];
    if (x > from && x < to) out.push_back(sampled.poses[k]);
  }
  if (from >= 0.0) {
    const AxisPlace place = at(from);
    out.insert(out.begin(), Pose{place.tip, place.u});
  }
  if (to > length() && last() > length()) add_between(after_, std::max(from, length()), std::min(to, last()));
  add(to);
  return out;
}

}  // namespace flank::internal
