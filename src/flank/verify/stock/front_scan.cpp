#include "flank/verify/stock/front_scan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flank::internal::verify {
namespace {

/// How far outside of the tool the front is looked at, in cells: what the tool has just cut ends a cell from there.
constexpr double kNear = 1.5, kFar = 3.0;
constexpr double kStep = 1.5 * std::numbers::pi / 180.0;

/// A contact circle with the frame of its motion.
struct Circle {
  Vec3 centre, forward, side, up;
  double radius = 0.0, sine = 0.0, cosine = 1.0;
  double half = 0.0;  ///< the front is |theta| <= half, radians

  [[nodiscard]] Vec3 at(double theta, double off) const {
    const Vec3 out = std::cos(theta) * forward + std::sin(theta) * side;
    return centre + (radius + off * cosine) * out + off * sine * up;
  }
};

Circle circle_of(const RadialFunction& radial, const Pose& pose, const PoseVelocity& velocity, double s) {
  Circle out;
  const RadialJet j = radial.at(s);
  out.sine = -j.d1;
  out.cosine = std::sqrt(std::max(0.0, 1.0 - j.d1 * j.d1));
  out.centre = pose.at(s - j.r * j.d1);
  out.radius = j.r * out.cosine;
  out.up = pose.axis;
  const Vec3 v = velocity.at(s);
  const double along = v.dot(pose.axis);
  const Vec3 across = v - along * pose.axis;
  const double speed = across.norm();
  if (!(speed > 1e-12 * v.norm()) || !(out.cosine > 0.0)) return out;
  out.forward = across / speed;
  out.side = pose.axis.cross(out.forward);
  // The surface moves outwards where <n, v> > 0, n = sine * up + cosine * (radial direction).
  out.half = std::acos(std::clamp(-out.sine * along / (out.cosine * speed), -1.0, 1.0));
  return out;
}

/// Where the sign changes between two angles: by halving, as the depth has jumps at edges.
double crossing(const DexelStock& stock, const Circle& circle, double off, double out, double in) {
  for (int k = 0; k < 9; ++k) {
    const double middle = 0.5 * (out + in);
    (stock.depth(circle.at(middle, off)) > 0.0 ? in : out) = middle;
  }
  return 0.5 * (out + in);
}

std::vector<FrontArc> arcs_at(const DexelStock& stock, const Circle& circle, double off) {
  std::vector<FrontArc> arcs;
  const int steps = std::max(4, static_cast<int>(std::ceil(2.0 * circle.half / kStep)));
  bool before = false;
  double last = -circle.half;
  for (int k = 0; k <= steps; ++k) {
    const double theta = circle.half * (2.0 * k / steps - 1.0);
    const bool in = stock.depth(circle.at(theta, off)) > 0.0;
    if (in && !before)
      arcs.push_back({k == 0 ? theta : crossing(stock, circle, off, last, theta), theta, k > 0, false});
    if (!in && before) arcs.back().high = crossing(stock, circle, off, theta, last), arcs.back().high_crosses = true;
    if (in) arcs.back().high = theta;
    before = in;
    last = theta;
  }
  return arcs;
}

/// The stock's surface crosses the two outer circles at two angles: where its straight continuation meets the tool's own, or
/// comes nearest to it.
double carried_back(const Circle& circle, double near_off, double near, double far_off, double far) {
  const double r1 = circle.radius + near_off * circle.cosine, r2 = circle.radius + far_off * circle.cosine;
  const Vec2 p(r1 * std::cos(near), r1 * std::sin(near)), q(r2 * std::cos(far), r2 * std::sin(far));
  const Vec2 d = (p - q).normalized();
  const double along = p.dot(d), root = along * along - p.squaredNorm() + circle.radius * circle.radius;
  const double k = root > 0.0 ? -along - std::sqrt(root) : -along;
  const Vec2 x = p + std::max(0.0, k) * d;
  // In the turn that the near angle is in.
  const double angle = std::atan2(x.y(), x.x());
  return near + std::remainder(angle - near, 2.0 * std::numbers::pi);
}

/// The arc of the outer circle that lies across from an arc of the inner one; null: none or several.
const FrontArc* partner(const std::vector<FrontArc>& near, const FrontArc& arc, const std::vector<FrontArc>& far) {
  const auto meets = [](const FrontArc& a, const FrontArc& b) { return a.low < b.high && b.low < a.high; };
  const FrontArc* found = nullptr;
  for (const FrontArc& other : far) {
    if (!meets(arc, other)) continue;
    if (found != nullptr) return nullptr;
    found = &other;
  }
  if (found == nullptr) return nullptr;
  return std::count_if(near.begin(), near.end(), [&](const FrontArc& a) { return meets(a, *found); }) == 1 ? found
                                                                                                           : nullptr;
}

}  // namespace

FrontScan::FrontScan(const RadialFunction& radial, int count) : radial_(radial), count_(std::max(2, count)) {}

double FrontScan::angle(const DexelStock& stock, const Pose& pose, const PoseVelocity& velocity, double s) const {
  const Circle circle = circle_of(radial_, pose, velocity, s);
  if (!(circle.half > 0.0)) return 0.0;
  const double near_off = kNear * stock.cell(), far_off = kFar * stock.cell();
  const std::vector<FrontArc> near = arcs_at(stock, circle, near_off);
  if (near.empty()) return 0.0;
  const std::vector<FrontArc> far = arcs_at(stock, circle, far_off);
  double sum = 0.0;
  for (const FrontArc& arc : near) {
    const FrontArc* other = partner(near, arc, far);
    double low = arc.low, high = arc.high;
    if (other != nullptr && arc.low_crosses && other->low_crosses)
      low = carried_back(circle, near_off, arc.low, far_off, other->low);
    if (other != nullptr && arc.high_crosses && other->high_crosses)
      high = carried_back(circle, near_off, arc.high, far_off, other->high);
    sum += std::max(0.0, std::min(high, circle.half) - std::max(low, -circle.half));
  }
  return sum;
}

FrontScan::Largest FrontScan::largest(const DexelStock& stock, const Pose& pose, const PoseVelocity& velocity) const {
  Largest out;
  for (int k = 0; k < count_; ++k) {
    const double s = radial_.axis_length() * k / (count_ - 1);
    const double angle = this->angle(stock, pose, velocity, s);
    if (angle > out.angle_rad) out = {angle, s};
  }
  return out;
}

}  // namespace flank::internal::verify
