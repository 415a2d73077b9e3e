#include "flank/trochoid/stock/tool_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

constexpr int kCells = 512;

/// The s whose meridian point has height z, near a guess.
double s_at_height(const RadialFunction& radial, double z, double s) {
  for (int k = 0; k < 30; ++k) {
    const RadialJet r = radial.at(s);
    const double step = (s - r.r * r.d1 - z) / (1.0 - r.d1 * r.d1 - r.r * r.d2);
    s = std::clamp(s - step, 0.0, radial.axis_length());
    if (std::abs(step) < 1e-13 * radial.axis_length()) break;
  }
  return s;
}

/// Weight of one of `count` places at equal steps, by the trapezoidal rule: the material ends within the tool, at the
/// blank's planes and at what was cut before, and Simpson's uneven weights would then count one ring twice as much as the next.
double weight(int i, int count) { return (i == 0 || i == count - 1 ? 0.5 : 1.0) / (count - 1); }

/// Rings of the sphere at one end, in the middles of equal steps from the flank's last normal to the pole: none lies where the
/// flank ends, as the top of a blank often does.
void add_cap(const RadialFunction& radial, bool tip, int count, std::vector<ToolRing>& rings) {
  for (int k = 0; k < count; ++k) {
    ToolRing ring = round_end_ring(radial, tip, (k + 0.5) / count);
    ring.area /= count;
    if (ring.area > 0.0) rings.push_back(ring);  // a point, or an end whose flank leads to its pole, has none
  }
}

}  // namespace

ToolProfile::ToolProfile(const RadialFunction& radial) : length_(radial.axis_length()) {
  const RadialJet tip = radial.at(0.0), end = radial.at(length_);
  tip_radius_ = tip.r;
  end_radius_ = end.r;
  first_ = -tip.r * tip.d1;
  last_ = length_ - end.r * end.d1;
  low_ = -tip.r;
  high_ = length_ + end.r;
  per_mm_ = kCells / (last_ - first_);
  double s = 0.0;
  for (int i = 0; i <= kCells; ++i) {
    const double z = first_ + (last_ - first_) * i / kCells;
    s = s_at_height(radial, z, s);
    const RadialJet r = radial.at(s);
    const double q = std::sqrt(std::max(0.0, 1.0 - r.d1 * r.d1));
    radius_.push_back(r.r * q);
    slope_.push_back(r.d1 / q);
  }
  largest_ = std::max(*std::max_element(radius_.begin(), radius_.end()), std::max(tip_radius_, end_radius_));
}

bool ToolProfile::at(double z, Place& place) const {
  if (!(z > low_ && z < high_)) return false;
  if (z >= first_ && z <= last_) {
    const double x = (z - first_) * per_mm_;
    const int i = std::min(static_cast<int>(x), kCells - 1);
    const double t = x - i, h = 1.0 / per_mm_;
    const auto k = static_cast<std::size_t>(i);
    // Cubic Hermite: radius and slope are exact at the cells' ends.
    const double d = radius_[k + 1] - radius_[k], a = slope_[k] * h - d, b = d - slope_[k + 1] * h;
    place.radius = radius_[k] + t * d + t * (1.0 - t) * (a * (1.0 - t) + b * t);
    place.slope = (d + (1.0 - 2.0 * t) * (a * (1.0 - t) + b * t) + t * (1.0 - t) * (b - a)) * per_mm_;
    return true;
  }
  const double centre = z < first_ ? 0.0 : length_, r = z < first_ ? tip_radius_ : end_radius_;
  const double up = z - centre;
  place.radius = std::sqrt(std::max(1e-300, r * r - up * up));
  place.slope = -up / place.radius;
  return true;
}

ToolRing ring_at(const RadialFunction& radial, double s) {
  const RadialJet r = radial.at(s);
  ToolRing ring;
  ring.s = s;
  ring.sine = -r.d1;
  ring.cosine = std::sqrt(std::max(0.0, 1.0 - r.d1 * r.d1));
  ring.z = s - r.r * r.d1;
  ring.radius = r.r * ring.cosine;
  return ring;
}

int ring_count(const RadialFunction& radial, double radii_apart, int least, int most) {
  const double steps = std::ceil(radial.axis_length() / (radii_apart * radial.largest()));
  return static_cast<int>(std::clamp(steps + 1.0, static_cast<double>(least), static_cast<double>(most)));
}

std::vector<ToolRing> tool_rings(const RadialFunction& radial, int count, int caps) {
  FLANK_ASSERT(count >= 2 && caps >= 0);
  std::vector<ToolRing> rings;
  const double length = radial.axis_length();
  for (int k = 0; k < count; ++k) {
    const double s = length * k / (count - 1);
    ToolRing ring = ring_at(radial, s);
    ring.area = flank_element(radial, s) * length * weight(k, count);
    rings.push_back(ring);
  }
  if (caps > 0) {
    add_cap(radial, true, caps, rings);
    add_cap(radial, false, caps, rings);
  }
  return rings;
}

ToolRing round_end_ring(const RadialFunction& radial, bool tip, double share) {
  const double s = tip ? 0.0 : radial.axis_length();
  const RadialJet r = radial.at(s);
  const double from = std::asin(-r.d1), to = (tip ? -0.5 : 0.5) * std::numbers::pi;
  const double beta = std::lerp(from, to, share);
  ToolRing ring;
  ring.s = s;
  ring.sine = std::sin(beta);
  ring.cosine = std::cos(beta);
  ring.z = s + r.r * ring.sine;
  ring.radius = r.r * ring.cosine;
  ring.area = r.r * r.r * ring.cosine * std::abs(to - from);
  ring.flank = false;
  return ring;
}

double flank_element(const RadialFunction& radial, double s) {
  // Of the envelope of spheres (MATH section 10).
  const RadialJet r = radial.at(s);
  return r.r * (1.0 - r.d1 * r.d1 - r.r * r.d2);
}

}  // namespace flank::internal
