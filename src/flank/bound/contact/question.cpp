#include "flank/bound/contact/question.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace flank::internal {
namespace {

/// Of the size of the face: what a footpoint may be off, with what sums of its coordinates lose.
constexpr double kRounding = 1e-11;

/// |r''| at so many places a span that a cubic spline's knots are among them, between which r'' is a straight line. For
/// the other families r'' has no more than one turn, and the margin covers what a step may miss.
double most_bend(const RadialFunction& radial) {
  const bool spline = radial.family() == ToolFamily::kSpline;
  const int steps = spline ? 4 * std::max(1, radial.parameter_count() - 3) : 512;
  double most = 0.0;
  for (int k = 0; k <= steps; ++k) most = std::max(most, std::abs(radial.at(radial.axis_length() * k / steps).d2));
  return spline ? most * (1.0 + 1e-9) : most * 1.02;
}

/// Balls that are tried, as shares of the largest, from the one that says most.
constexpr std::array<double, 5> kRoofs = {1.0, 0.3, 0.1, 0.05, 0.03};

}  // namespace

ContactQuestion::ContactQuestion(const Target& face, const RadialFunction& tool, double asked_mm)
    : target(&face),
      radial(&tool),
      tolerance_mm(asked_mm + kRounding * (face.diagonal() + face.box().low.norm() + face.box().high.norm())),
      length_mm(tool.axis_length()),
      thin_mm(tool.smallest()),
      thick_mm(tool.largest()),
      steepest(tool.steepest()),
      bend(most_bend(tool)) {}

AxisProbe probe_axis(const ContactQuestion& question, const Vec3& p, double horizon_mm, double roof_mm) {
  AxisProbe probe;
  const Footpoint foot = question.target->closest_within(p, horizon_mm);
  probe.far = foot.patch < 0;
  if (probe.far) {
    probe.distance_mm = horizon_mm;
    return probe;
  }
  const Vec3 away = p - foot.point;
  probe.distance_mm = away.norm();
  probe.normal = probe.distance_mm > 1e-9 ? Vec3(away / probe.distance_mm) : foot.normal;
  // Near a centre of curvature the nearest point is expensive to find, and the ball is hardly free there.
  const double bend = foot.location == Location::kInside ? foot.k2 : 0.0;
  const double largest = bend > 0.0 ? std::min(roof_mm, 0.8 / bend) : roof_mm;
  for (const double share : kRoofs) {
    const double radius = probe.distance_mm + share * (largest - probe.distance_mm);
    if (!(radius > 1.02 * probe.distance_mm)) break;
    const Vec3 centre = foot.point + radius * probe.normal;
    // What is not found within the radius is farther away: the ball is free.
    const Footpoint other = question.target->closest_within(centre, radius);
    const double lack = other.patch < 0 ? 0.0 : std::max(0.0, radius - (centre - other.point).norm());
    if (lack > 0.01 * question.tolerance_mm) continue;
    probe.roof_mm = radius;
    probe.lack_mm = lack;
    break;
  }
  return probe;
}

ContactSite::ContactSite(const ContactQuestion& question, const Vec3& near) {
  const Footpoint foot = question.target->closest(near);
  point = foot.point;
  normal = foot.normal;
  across = normal.unitOrthogonal();
  along = normal.cross(across);
  const double e = question.tolerance_mm;
  const double thin = std::max(question.thin_mm - e, 0.1 * question.thin_mm), thick = question.thick_mm + e;
  const double largest = std::max(30.0 * thick, 0.5 * question.target->diagonal());
  const AxisProbe probe = probe_axis(question, point + 1e-3 * thin * normal, thin, largest);
  roof_mm = probe.far || probe.roof_mm < 1.02 * thick ? 0.0 : probe.roof_mm;
  // Where the tool sinks, the point itself is too near; where it rises, the free ball says that the face is too far.
  const double sink = 1.0 / thin + question.bend;
  const double rise = roof_mm > 0.0 ? 1.0 / (roof_mm - thick) + question.bend : sink;
  const double worst = std::max(sink, rise), half = std::sqrt(4.0 * e / worst);
  least_mm = 2.0 * half;
  slope_max = roof_mm > 0.0 ? (2.0 * e + probe.lack_mm) / half + 0.5 * worst * half : 2.0;
}

}  // namespace flank::internal
