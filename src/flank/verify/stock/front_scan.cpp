#include "flank/verify/stock/front_scan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flank::internal::verify {
namespace {

/// Arcs, and gaps between them, that are narrower than this may be missed.
constexpr double kStep = 1.5 * std::numbers::pi / 180.0;

/// A contact circle with the frame of its motion.
struct Circle {
  Vec3 centre, forward, side;
  double radius = 0.0;
  double half = 0.0;  ///< the front is |theta| <= half, radians

  [[nodiscard]] Vec3 outwards(double theta) const { return std::cos(theta) * forward + std::sin(theta) * side; }
};

Circle circle_of(const RadialFunction& radial, const Pose& pose, const PoseVelocity& velocity, double s) {
  Circle out;
  const RadialJet j = radial.at(s);
  const double sine = -j.d1, cosine = std::sqrt(std::max(0.0, 1.0 - j.d1 * j.d1));
  out.centre = pose.at(s - j.r * j.d1);
  out.radius = j.r * cosine;
  const Vec3 v = velocity.at(s);
  const double along = v.dot(pose.axis);
  const Vec3 across = v - along * pose.axis;
  const double speed = across.norm();
  if (!(speed > 1e-12 * v.norm()) || !(cosine > 0.0)) return out;
  out.forward = across / speed;
  out.side = pose.axis.cross(out.forward);
  // The surface moves outwards where <n, v> > 0, n = sine * up + cosine * (radial direction).
  out.half = std::acos(std::clamp(-sine * along / (cosine * speed), -1.0, 1.0));
  return out;
}

/// In a direction from the circle's centre.
bool is_engaged(const DexelStock& stock, const MovingTool& tool, const Circle& circle, const Vec3& outwards) {
  // Where a front goes along a surface that was cut before, the stock has the ridges between its own cuts: what the tool meets must
  // reach farther into it. What was taken lately is asked on the front itself, since such poses leave next to nothing.
  const Vec3 inside = circle.centre + (circle.radius - tool.grain_mm) * outwards;
  if (!(tool.empty == nullptr ? stock.holds(inside, outwards) : stock.holds(inside, outwards, *tool.empty)))
    return false;
  return tool.lately == nullptr || !tool.solid->holds(*tool.lately, circle.centre + circle.radius * outwards);
}

/// Where the answer changes between two angles: by halving, as the depth has jumps at edges.
double crossing(const DexelStock& stock, const MovingTool& tool, const Circle& circle, double out, double in) {
  constexpr int kHalvings = 9;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (out + in);
    (is_engaged(stock, tool, circle, circle.outwards(middle)) ? in : out) = middle;
  }
  return 0.5 * (out + in);
}

}  // namespace

FrontScan::FrontScan(const RadialFunction& radial, int count) : radial_(radial), count_(std::max(2, count)) {}

double FrontScan::angle(const DexelStock& stock, const MovingTool& tool, double s) const {
  const Circle circle = circle_of(radial_, tool.pose, tool.velocity, s);
  if (!(circle.half > 0.0)) return 0.0;
  const int steps = std::max(4, static_cast<int>(std::ceil(2.0 * circle.half / kStep)));
  const auto at = [&](int k) { return circle.half * (2.0 * (k + 0.5) / steps - 1.0); };
  double sum = 0.0, from = -circle.half;
  const auto is_in = [&](const Vec2& u) {
    return is_engaged(stock, tool, circle, u.x() * circle.forward + u.y() * circle.side);
  };
  // From one angle to the next by a turn, without sine and cosine.
  const double step = 2.0 * circle.half / steps;
  const Vec2 turn(std::cos(step), std::sin(step));
  Vec2 direction(std::cos(at(0)), std::sin(at(0)));
  bool before = is_in(direction);
  for (int k = 1; k < steps; ++k) {
    direction =
        Vec2(turn.x() * direction.x() - turn.y() * direction.y(), turn.y() * direction.x() + turn.x() * direction.y());
    const bool in = is_in(direction);
    if (in == before) continue;
    const double place =
        in ? crossing(stock, tool, circle, at(k - 1), at(k)) : crossing(stock, tool, circle, at(k), at(k - 1));
    if (in)
      from = place;
    else
      sum += place - from;
    before = in;
  }
  return before ? sum + circle.half - from : sum;
}

FrontScan::Largest FrontScan::largest(const DexelStock& stock, const MovingTool& tool) const {
  Largest out;
  for (int k = 0; k < count_; ++k) {
    const double s = radial_.axis_length() * k / (count_ - 1);
    const double angle = this->angle(stock, tool, s);
    if (angle > out.angle_rad) out = {angle, s};
  }
  return out;
}

}  // namespace flank::internal::verify
