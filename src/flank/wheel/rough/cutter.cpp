#include "flank/wheel/rough/cutter.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

constexpr int kSteps = 64;  ///< of the axis
constexpr int kMostCircles = 40;
constexpr double kApartShare = 0.35;  ///< of the tip's radius, between circles

}  // namespace

Cutter::Cutter(const RadialFunction& radial)
    : length_(radial.axis_length()), step_(length_ / kSteps), largest_(radial.largest()) {
  for (int k = 0; k <= kSteps; ++k) {
    const RadialJet jet = radial.at(std::min(length_, k * step_));
    radii_.push_back(jet.r);
    slopes_.push_back(std::clamp(jet.d1, -0.99, 0.99));
  }
  const int count = std::clamp(static_cast<int>(std::ceil(length_ / (kApartShare * tip()))), 2, kMostCircles);
  for (int k = 0; k <= count; ++k) {
    const double s = length_ * k / count;
    const RadialJet jet = radial.at(s);
    circles_.push_back({s, s - jet.r * jet.d1, jet.r * std::sqrt(std::max(0.0, 1.0 - jet.d1 * jet.d1))});
  }
}

double Cutter::radius(double s) const {
  const double x = std::clamp(s, 0.0, length_) / step_;
  const auto k = std::min(static_cast<std::size_t>(x), radii_.size() - 2);
  return std::lerp(radii_[k], radii_[k + 1], x - static_cast<double>(k));
}

double Cutter::largest_near(double s, double far) const {
  const auto at = [&](double x) {
    return static_cast<std::size_t>(std::clamp(x / step_, 0.0, static_cast<double>(kSteps)));
  };
  far += largest_;  // a sphere is as high as it is thick
  const std::size_t last = std::min<std::size_t>(at(s + far) + 1, kSteps);
  return *std::max_element(radii_.begin() + static_cast<std::ptrdiff_t>(at(s - far)),
                           radii_.begin() + static_cast<std::ptrdiff_t>(last) + 1);
}

double Cutter::distance(double z, double off) const {
  const auto k = static_cast<std::size_t>(std::clamp(z / step_, 0.0, static_cast<double>(kSteps)));
  const double slope = slopes_[k], s = std::clamp(z + off * slope / std::sqrt(1.0 - slope * slope), 0.0, length_);
  return std::sqrt(off * off + (z - s) * (z - s)) - radius(s);
}

}  // namespace flank::internal
