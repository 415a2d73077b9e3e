#include "flank/verify/clearance/flank_profile.h"

#include <algorithm>
#include <cmath>

#include "flank/tool.h"

namespace flank::internal::verify {
namespace {

/// First cut of the axis, so that no bend hides between samples, and most halvings of one of the pieces: 16 * 2^10
/// pieces are more than 5e-4 mm asks of a smooth meridian. The limit ends the recursion where the meridian has a
/// kink.
constexpr int kFirstPieces = 16, kDeepest = 10;

double off_chord(const Vec2& a, const Vec2& b, const Vec2& x) {
  const Vec2 d = b - a;
  const double length = d.norm();
  return length > 0.0 ? std::abs(d.x() * (x.y() - a.y()) - d.y() * (x.x() - a.x())) / length : (x - a).norm();
}

/// Appends the outline from s0 (excluded) to s1. The quarter points catch what the middle of an S-shaped piece hides.
void append(const RadialFunction& radial, double s0, double s1, int depth, std::vector<Vec2>& out) {
  const Vec2 a = meridian_point(radial, s0), b = meridian_point(radial, s1);
  double off = 0.0;
  for (double f : {0.25, 0.5, 0.75}) off = std::max(off, off_chord(a, b, meridian_point(radial, s0 + f * (s1 - s0))));
  // Half of what is promised: between the three places the outline may be off by a little more than at them.
  if (off > 0.5 * kFlankProfileErrorMm && depth < kDeepest) {
    append(radial, s0, 0.5 * (s0 + s1), depth + 1, out);
    append(radial, 0.5 * (s0 + s1), s1, depth + 1, out);
    return;
  }
  out.push_back(b);
}

}  // namespace

std::vector<Vec2> flank_profile(const RadialFunction& radial) {
  const double length = radial.axis_length();
  std::vector<Vec2> out{meridian_point(radial, 0.0)};
  for (int i = 0; i < kFirstPieces; ++i)
    append(radial, length * i / kFirstPieces, length * (i + 1) / kFirstPieces, 0, out);
  // A radial function that is no tool (a fit that failed) still makes bodies.
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k].y() = std::isfinite(out[k].y()) ? std::max(0.0, out[k].y()) : 0.0;
    if (!std::isfinite(out[k].x())) out[k].x() = k > 0 ? out[k - 1].x() : 0.0;
    if (k > 0) out[k].x() = std::max(out[k].x(), out[k - 1].x());
  }
  return out;
}

std::vector<Revolved> flank_bodies(const RadialFunction& radial) {
  std::vector<Revolved> bodies = convex_bodies(flank_profile(radial));
  for (double s : {0.0, radial.axis_length()})
    bodies.emplace_back(std::vector<Vec2>{Vec2(s, 0.0)}, std::max(0.0, radial.at(s).r));
  return bodies;
}

}  // namespace flank::internal::verify
