#include "flank/tool/smooth_tool.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flank::internal {
namespace {

/// Where the influence of each coefficient of a clamped cubic spline with equal knots is centred, as a share of its length:
/// the mean of its three inner knots.
double centre_of(Eigen::Index i, Eigen::Index count) {
  const double spans = static_cast<double>(count) - 3.0;
  double sum = 0.0;
  for (Eigen::Index k = i - 2; k <= i; ++k) sum += std::clamp(static_cast<double>(k), 0.0, spans);
  return sum / (3.0 * spans);
}

/// Where spheres are farthest from being inscribed, as a share of the length.
double worst_place(const RadialFunction& radial, Eigen::Index count) {
  const Eigen::Index places = 8 * count;
  double worst = 0.0, least = std::numeric_limits<double>::infinity();
  for (Eigen::Index k = 0; k <= places; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(places);
    const RadialJet j = radial.at(share * radial.axis_length());
    const double margin = 1.0 - j.d1 * j.d1 - std::max(0.0, j.r * j.d2);
    if (margin < least) least = margin, worst = share;
  }
  return worst;
}

/// The inner coefficient that acts most at a share of the length.
Eigen::Index inner_at(double share, Eigen::Index count) {
  Eigen::Index best = 1;
  for (Eigen::Index i = 1; i + 1 < count; ++i)
    if (std::abs(centre_of(i, count) - share) < std::abs(centre_of(best, count) - share)) best = i;
  return best;
}

}  // namespace

std::optional<RadialFunction> smoothed_to_tool(const RadialFunction& radial, double most_mm) {
  /// Of the way to the straight line between the neighbours: half is the most that cannot make a wave of a kink.
  constexpr double kStep = 0.5;
  /// A bend spreads by a coefficient in a few steps: enough for all of them.
  constexpr int kMostSteps = 400;
  if (radial.family() != ToolFamily::kSpline || !radial.parameters().allFinite()) return std::nullopt;
  RadialFunction smooth = radial;
  for (int step = 0; step < kMostSteps; ++step) {
    if (check_legitimacy(smooth).legitimate) return smooth;
    Eigen::VectorXd c = smooth.parameters();
    const Eigen::Index i = inner_at(worst_place(smooth, c.size()), c.size());
    const double low = centre_of(i - 1, c.size()), high = centre_of(i + 1, c.size());
    const double between = std::lerp(c[i - 1], c[i + 1], (centre_of(i, c.size()) - low) / (high - low));
    c[i] += kStep * (between - c[i]);
    if (std::abs(c[i] - radial.parameters()[i]) > most_mm) return std::nullopt;
    smooth = smooth.with_parameters(c);
  }
  return std::nullopt;
}

}  // namespace flank::internal
