#include "flank/redesign/millable_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/envelope.h"
#include "flank/envelope/fitted_surface.h"
#include "flank/envelope/swept_estimate.h"

namespace flank::internal {
namespace {

constexpr double kBorderShare = 1.0 / 200.0;  ///< spacing of the border points, of the diagonal
constexpr double kPlaceShare = 1.0 / 50.0;    ///< of the samples of the face
constexpr int kPoses = 200;
/// How far past the borders the surface reaches, as shares of its range; what is tried one after the other.
constexpr std::array<double, 3> kMargins = {0.015, 0.03, 0.06};

struct Range {
  double low = 1e300, high = -1e300;
  void add(double x) { low = std::min(low, x), high = std::max(high, x); }
  [[nodiscard]] Range wider(double share) const { return {low - share * (high - low), high + share * (high - low)}; }
  [[nodiscard]] double at(double share) const { return low + share * (high - low); }
};

/// Where the motion touches the face: places of it, with times and places of the axis.
struct Touch {
  Vec3 point;
  double t = 0.0, s = 0.0;
};

std::vector<Touch> touches(const RuledMotion& motion, const RadialFunction& radial, const std::vector<Vec3>& points) {
  const SweptEstimate swept({motion}, radial, kPoses);
  std::vector<Touch> all;
  for (const Vec3& p : points) {
    const SweptContact contact = swept.refine(p, swept.nearest(p));
    all.push_back({p, contact.t, contact.s});
  }
  return all;
}

/// Largest |c| where the face is touched.
double largest_c(const RuledMotion& motion, const RadialFunction& radial, int side, const std::vector<Touch>& touched) {
  double largest = 0.0;
  for (const Touch& at : touched)
    largest = std::max(largest, std::abs(contact_point(motion.jet(at.t), radial.at(at.s), at.s, side).c));
  return largest;
}

/// The envelope over these ranges.
MillableSurface over_range(const RuledMotion& motion, const RadialFunction& radial, int side, const Range& t,
                           const Range& s, double aim_mm) {
  const auto exact = [&](double u, double v) {
    return contact_point(motion.jet(t.at(u)), radial.at(s.at(v)), s.at(v), side);
  };
  const double length = radial.axis_length();
  FittedSurface fitted =
      fitted_surface([&](double u, double v) { return exact(u, v).point; },
                     SurfaceDirection(breaks_of(motion, t.low, t.high), kFittedDegree),
                     SurfaceDirection(breaks_of(radial, s.low / length, s.high / length), kFittedDegree), aim_mm);
  MillableSurface out;
  const SurfaceJet middle = fitted.surface.jet(0.5, 0.5);
  // The normal of a contact point looks from the axis to the part.
  out.reversed = middle.du.cross(middle.dv).dot(exact(0.5, 0.5).normal) > 0.0;
  out.surface = std::move(fitted.surface);
  Face whole;
  whole.surface = out.surface;
  whole.reversed = out.reversed;
  out.target = make_target({whole});
  return out;
}

}  // namespace

std::optional<Vec2> MillableSurface::nearest(const Vec3& p) const {
  const Footpoint foot = target->closest(p);
  if (foot.location != Location::kInside) return {};
  return Vec2(foot.u, foot.v);
}

double MillableSurface::over(const Vec3& p) const { return -target->closest(p).distance; }

std::optional<MillableSurface> millable_surface(const RuledMotion& motion, const RadialFunction& radial,
                                                const Target& face, double aim_mm, std::string& why) {
  const Vec3 middle = motion.pose(0.5).at(0.5 * radial.axis_length());
  const int side = contact_side(motion, radial, face.closest(middle).point - middle);
  const std::vector<Vec3> border = face.border_points(kBorderShare * face.diagonal());
  std::vector<Vec3> places = border;
  for (const SurfaceSample& sample : face.samples(kPlaceShare * face.diagonal())) places.push_back(sample.point);
  const std::vector<Touch> touched = touches(motion, radial, places);
  const double c = largest_c(motion, radial, side, touched);
  if (!(c < 1.0)) {
    why = fmt::format("the tool moves along its own axis where it touches (axial slip |c| = {:.3f})", c);
    return {};
  }
  Range t, s;
  for (const Touch& at : touched) t.add(at.t), s.add(at.s);
  for (const double margin : kMargins) {
    const Range wide_t = t.wider(margin), wide_s = s.wider(margin);
    MillableSurface out = over_range(motion, radial, side, wide_t, wide_s, aim_mm);
    const auto beyond = std::count_if(border.begin(), border.end(), [&](const Vec3& p) { return !out.nearest(p); });
    if (beyond > 0) {
      why = fmt::format("the surface that the tool leaves ends before {:.2g} % of the face's border",
                        100.0 * static_cast<double>(beyond) / static_cast<double>(border.size()));
      continue;
    }
    // Beyond the face the surface may fold; what counts is how near it is to the envelope where the face is.
    out.deviation_mm = 0.0;
    for (const Touch& at : touched) {
      const Vec3 exact = contact_point(motion.jet(at.t), radial.at(at.s), at.s, side).point;
      const Vec3 spline = out.surface.value((at.t - wide_t.low) / (wide_t.high - wide_t.low),
                                            (at.s - wide_s.low) / (wide_s.high - wide_s.low));
      out.deviation_mm = std::max(out.deviation_mm, (spline - exact).norm());
    }
    constexpr double kEnd = 1e-6;
    const auto at_end = [](double share) { return share < kEnd || share > 1.0 - kEnd; };
    for (const Touch& at : touched) {
      const double along = at.s / radial.axis_length();
      if (at_end(at.t))
        ++out.at_ends.of_motion;
      else if (at_end(along))
        ++(along < 0.5 ? out.at_ends.at_tip : out.at_ends.at_top);
    }
    why.clear();
    out.largest_c = c;
    out.used_from_s = s.low, out.used_to_s = s.high, out.used_from_t = t.low, out.used_to_t = t.high;
    return out;
  }
  return {};
}

}  // namespace flank::internal
