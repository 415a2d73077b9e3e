#include "flank/verify/swept/sphere_distance.h"

#include <algorithm>

namespace flank::internal::verify {
namespace {

constexpr double kPolishedMm = 1e-6;  ///< last step of s
/// Steps of Newton's method for s, least q = 1 - r'^2, and least slope: with less the root is nearly double, and steps
/// run away. Where any of these fails the caller searches without a start.
constexpr int kMostSteps = 16;
constexpr double kLeastQ = 1e-6, kLeastSlope = 0.02;

}  // namespace

// A stationary s solves (s - z)/D = r', that is s - z - rho r'/sqrt(1 - r'^2) = 0. This form has no pole at D = 0 and
// its slope 1 - rho r''/(1 - r'^2)^(3/2) is positive exactly at minima.
bool polish_sphere(const RadialTable& radial, double z, double rho, double& s) {
  for (int i = 0; i < kMostSteps; ++i) {
    const RadialJet j = radial.at(s);
    const double q = 1.0 - j.d1 * j.d1;
    if (q < kLeastQ) return false;
    const double w = 1.0 / std::sqrt(q);
    const double residual = s - z - rho * j.d1 * w;
    const double slope = 1.0 - rho * j.d2 * w * w * w;
    if (slope < kLeastSlope) return false;
    const double next = std::clamp(s - residual / slope, 0.0, radial.length());
    const double step = std::abs(next - s);
    s = next;
    if (step < kPolishedMm) return true;
  }
  return false;
}

}  // namespace flank::internal::verify
