#include "flank/wheel/rough/cutter.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

constexpr double kApartShare = 0.35;  ///< of the radius there, between circles

}  // namespace

Cutter::Cutter(const RadialFunction& radial)
    : length_(radial.axis_length()), step_(length_ / kPieces), largest_(radial.largest()) {
  for (int k = 0; k <= kPieces; ++k) {
    const RadialJet jet = radial.at(std::min(length_, k * step_));
    radii_.push_back(jet.r);
    const double slope = std::clamp(jet.d1, -0.99, 0.99);
    leans_.push_back(slope / std::sqrt(1.0 - slope * slope));
  }
  for (double s = 0.0; s < length_; s += kApartShare * circles_.back().radius) {
    const RadialJet jet = radial.at(s);
    circles_.push_back({s, s - jet.r * jet.d1, jet.r * std::sqrt(std::max(0.0, 1.0 - jet.d1 * jet.d1))});
  }
}

double Cutter::largest_near(double s, double far) const {
  const auto at = [&](double x) {
    return static_cast<std::size_t>(std::clamp(x / step_, 0.0, static_cast<double>(kPieces)));
  };
  far += largest_;  // a sphere is as high as it is thick
  const std::size_t last = std::min<std::size_t>(at(s + far) + 1, kPieces);
  return *std::max_element(radii_.begin() + static_cast<std::ptrdiff_t>(at(s - far)),
                           radii_.begin() + static_cast<std::ptrdiff_t>(last) + 1);
}

}  // namespace flank::internal
