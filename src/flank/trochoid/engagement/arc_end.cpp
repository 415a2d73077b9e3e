#include "flank/trochoid/engagement/arc_end.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

/// Steps after which an end is known, because the next one would be a ten-thousandth of them: mm, intervals. The gap does not
/// feel the time to the first order.
constexpr double kStepMm = 1e-6, kInterval = 1e-4;
/// For second derivatives, of an interval and radians.
constexpr double kProbe = 1e-4;
/// An end is looked for this near to the guess, radians; a step goes no farther.
constexpr double kFarthest = 0.3;

struct EndStep {
  double angle = 0.0, place = 0.0;
};

/// Newton's step for gap = 0 and d gap / dt = 0, or for the gap alone where time is at its bounds.
EndStep step_of(const ToolProfile& profile, const RingCircle& circle, const SweepPlace& cover, double angle, double t) {
  const SweepAxis axis(cover.sweep->at(t));
  const double c = std::cos(angle), d = std::sin(angle);
  const Vec3 x = circle.centre + circle.radius * (c * circle.x + d * circle.y), along = c * circle.y - d * circle.x;
  const GapJet g = gap_at(profile, axis, x);
  const double by_angle = circle.radius * g.gradient.dot(along), back = t + kProbe > cover.last ? -kProbe : kProbe;
  const double tt = (gap_at(profile, cover.sweep->at(t + back), x).dt - g.dt) / back;
  const double ta = (gap_at(profile, axis, x + kProbe * circle.radius * along).dt - g.dt) / kProbe;
  const bool low = t <= 0.0 && g.dt >= 0.0, high = t >= cover.last && g.dt <= 0.0;
  const double determinant = by_angle * tt - g.dt * ta;
  EndStep step;
  if (!low && !high && tt > 0.0 && std::abs(determinant) > 1e-12) {
    step.angle = (-g.gap * tt + g.dt * g.dt) / determinant;
    step.place = (-by_angle * g.dt + ta * g.gap) / determinant;
  } else if (std::abs(by_angle) > 1e-12) {
    step.angle = -g.gap / by_angle;
    // Downhill in time as far as half an interval, if the curvature says nothing.
    if (!low && !high && !(tt > 0.0)) step.place = g.dt > 0.0 ? -0.5 : 0.5;
  }
  return {std::clamp(step.angle, -kFarthest, kFarthest), std::clamp(step.place, -1.0, 1.0)};
}

/// Where `is_taken` ends before `angle` against the sign, or begins behind it; `angle` if that is not near.
template <class IsTaken>
double halved_end(const IsTaken& is_taken, double angle, double sign) {
  constexpr int kSteps = 12, kHalvings = 14;
  constexpr double kInside = 1e-6;  // the guess itself is an end of what a pose takes
  const bool there = is_taken(angle + sign * kInside);
  const double step = (there ? -sign : sign) * kFarthest / kSteps;
  for (int k = 1; k <= kSteps; ++k) {
    double same = angle + (k - 1) * step, other = angle + k * step;
    if (is_taken(other) == there) continue;
    for (int n = 0; n < kHalvings; ++n) {
      const double middle = 0.5 * (same + other);
      (is_taken(middle) == there ? same : other) = middle;
    }
    return there ? same : other;
  }
  return angle;
}

}  // namespace

double arc_end(const ToolProfile& profile, const RingCircle& circle, const SweepPlace& cover, double angle,
               Taken taken) {
  constexpr int kIterations = 12;
  /// What an end moves from its guess because of the time between poses and a small tilt is less, radians.
  constexpr double kUsual = 2e-3;
  double at = angle, t = cover.place;
  bool settled = false;
  for (int k = 0; k < kIterations && !settled; ++k) {
    const EndStep step = step_of(profile, circle, cover, at, t);
    const double moved = std::clamp(t + step.place, 0.0, cover.last) - t;
    at += step.angle;
    t += moved;
    settled = std::abs(step.angle) * circle.radius < kStepMm && std::abs(moved) < kInterval;
  }
  if (settled && std::abs(at - angle) < kUsual) return at;
  const auto is_taken = [&](double a) {
    const Vec3 x = circle.at(a);
    return is_taken_near(profile, cover, x) || is_taken_near(profile, {cover.sweep, cover.last, t}, x);
  };
  const double sign = taken == Taken::kAbove ? 1.0 : -1.0;
  const bool onwards = (at - angle) * sign < 0.0;  // it takes more than was guessed
  const double beside = std::copysign(0.5 * kUsual, angle - at);
  if (settled && std::abs(at - angle) < kFarthest && is_taken(0.5 * (at + angle)) == onwards &&
      is_taken(at + beside) == onwards)
    return at;
  return halved_end(is_taken, angle, sign);
}

bool is_taken_near(const ToolProfile& profile, const SweepPlace& cover, const Vec3& x) {
  constexpr int kIterations = 8;
  double t = cover.place;
  for (int k = 0; k < kIterations; ++k) {
    const GapJet g = gap_at(profile, cover.sweep->at(t), x);
    if (g.gap <= 0.0) return true;
    const double back = t + kProbe > cover.last ? -kProbe : kProbe;
    const double tt = (gap_at(profile, cover.sweep->at(t + back), x).dt - g.dt) / back;
    const double step = tt > 0.0 ? std::clamp(-g.dt / tt, -1.0, 1.0) : (g.dt > 0.0 ? -0.5 : 0.5);
    const double next = std::clamp(t + step, 0.0, cover.last);
    if (std::abs(next - t) < 1e-6) return false;
    t = next;
  }
  return false;
}

}  // namespace flank::internal
