#include "flank/verify/stock/front_circle.h"

#include <algorithm>
#include <cmath>

namespace flank::internal::verify {

FrontCircle front_circle(const RadialFunction& radial, const Pose& pose, const PoseVelocity& velocity, double s) {
  FrontCircle out;
  const RadialJet j = radial.at(s);
  out.sine = -j.d1, out.cosine = std::sqrt(std::max(0.0, 1.0 - j.d1 * j.d1));
  out.axis = pose.axis;
  out.centre = pose.at(s - j.r * j.d1);
  out.radius = j.r * out.cosine;
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

}  // namespace flank::internal::verify
