#include "flank/correct/measure/ground_tool.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "flank/error.h"

namespace flank::internal {
namespace {

constexpr std::size_t kFewest = 20;  ///< points on the flank
constexpr double kWidestGap = 0.15;  ///< share of the flank that may be without a point
constexpr double kOutlier = 5.0;     ///< standard deviations
constexpr double kOtherTool = 0.25;  ///< share of the mean radius by which a ground tool never differs
constexpr int kRounds = 4;
constexpr std::array<int, 7> kCounts = {4, 6, 8, 12, 16, 24, 32};

/// A point on the flank: where its sphere is, and how far outside of it the point lies.
struct OnFlank {
  int index = 0;
  double s = 0.0, outside = 0.0;
};

/// The sphere to which a point belongs is the one that it is deepest in, or least far outside of.
std::optional<OnFlank> place(const RadialFunction& radial, const Vec2& p, int index) {
  const double length = radial.axis_length(), rho = std::abs(p.y());
  const auto slope = [&](double s) { return s - p.x() - radial.at(s).d1 * std::hypot(s - p.x(), rho); };
  double low = 0.0, high = length;
  if (!(slope(low) < 0.0 && slope(high) > 0.0)) return {};
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (slope(middle) < 0.0 ? low : high) = middle;
  }
  return OnFlank{index, low, std::hypot(low - p.x(), rho) - radial.at(low).r};
}

std::vector<OnFlank> place_all(const RadialFunction& radial, const std::vector<Vec2>& points,
                               const std::vector<char>& left_out) {
  std::vector<OnFlank> placed;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (left_out[k] != 0) continue;
    if (const std::optional<OnFlank> point = place(radial, points[k], static_cast<int>(k))) placed.push_back(*point);
  }
  return placed;
}

struct SplineFit {
  RadialFunction difference;
  double score = 0.0, noise = 0.0;
};

/// Least squares of `outside` over s, with a little smoothing that decides where no points are.
SplineFit fit_difference(const std::vector<OnFlank>& placed, double length, int count) {
  RadialFunction spline = RadialFunction::spline(length, Eigen::VectorXd::Zero(count));
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  std::array<double, 4> basis{};
  for (const OnFlank& point : placed) {
    const int first = spline.first_active(point.s);
    spline.active_gradient(point.s, basis.data());
    for (int i = 0; i < 4; ++i) {
      right[first + i] += basis[static_cast<std::size_t>(i)] * point.outside;
      for (int j = 0; j < 4; ++j)
        normal(first + i, first + j) += basis[static_cast<std::size_t>(i)] * basis[static_cast<std::size_t>(j)];
    }
  }
  const double weight = 1e-4 * normal.trace() / count;
  for (int i = 0; i + 2 < count; ++i) {
    Eigen::VectorXd bend = Eigen::VectorXd::Zero(count);
    bend[i] = 1.0, bend[i + 1] = -2.0, bend[i + 2] = 1.0;
    normal += weight * bend * bend.transpose();
  }
  SplineFit fit;
  fit.difference = spline.with_parameters(normal.ldlt().solve(right));
  double square = 0.0;
  for (const OnFlank& point : placed) square += std::pow(point.outside - fit.difference.at(point.s).r, 2);
  const auto n = static_cast<double>(placed.size());
  fit.noise = std::sqrt(square / (n - count));
  fit.score = square / n / std::pow(1.0 - count / n, 2);
  return fit;
}

SplineFit best_difference(const std::vector<OnFlank>& placed, double length) {
  SplineFit best = fit_difference(placed, length, kCounts.front());
  for (const int count : kCounts) {
    if (2 * static_cast<std::size_t>(count) > placed.size()) break;
    SplineFit fit = fit_difference(placed, length, count);
    // More coefficients have to be worth it.
    if (fit.score < 0.98 * best.score) best = std::move(fit);
  }
  return best;
}

/// The sum of both, as one spline.
RadialFunction sum_of(const RadialFunction& nominal, const RadialFunction& difference) {
  constexpr int kSamples = 801;
  const double length = nominal.axis_length();
  std::vector<Vec2> samples;
  for (int k = 0; k < kSamples; ++k) {
    const double s = length * k / (kSamples - 1);
    samples.emplace_back(s, nominal.at(s).r + difference.at(s).r);
  }
  return RadialFunction::spline_through(length, samples, 64);
}

[[noreturn]] void refuse(const std::string& file, const std::string& why) { throw InputError(file + ": " + why); }

void require_covered(const std::vector<OnFlank>& placed, double length, const std::string& file) {
  if (placed.size() < kFewest)
    refuse(file, std::to_string(placed.size()) + " points lie on the flank; at least " + std::to_string(kFewest) +
                     " points (z, radius) in mm are required, z along the axis from the centre of the tip's sphere");
  std::vector<double> s = {0.0, length};
  for (const OnFlank& point : placed) s.push_back(point.s);
  std::sort(s.begin(), s.end());
  for (std::size_t k = 1; k < s.size(); ++k)
    if (s[k] - s[k - 1] > kWidestGap * length) {
      std::array<char, 200> text{};
      std::snprintf(text.data(), text.size(),
                    "no point from %.4g to %.4g mm of the axis (of %.4g); measure points all along the flank", s[k - 1],
                    s[k], length);
      refuse(file, text.data());
    }
}

}  // namespace

GroundTool fit_ground(const RadialFunction& nominal, const std::vector<Vec2>& points, const std::string& file) {
  const double length = nominal.axis_length();
  std::vector<char> left_out(points.size(), 0);
  GroundTool ground;
  ground.radial = nominal;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<OnFlank> placed = place_all(ground.radial, points, left_out);
    require_covered(placed, length, file);
    // Differences from the nominal tool are smooth; those from the last round's are not.
    for (OnFlank& point : placed) point.outside += ground.radial.at(point.s).r - nominal.at(point.s).r;
    const SplineFit fit = best_difference(placed, length);
    std::vector<double> sizes;
    for (const OnFlank& point : placed) sizes.push_back(std::abs(point.outside - fit.difference.at(point.s).r));
    std::nth_element(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2), sizes.end());
    const double typical = std::max(1.4826 * sizes[sizes.size() / 2], 1e-9);
    for (const OnFlank& point : placed)
      if (std::abs(point.outside - fit.difference.at(point.s).r) > kOutlier * typical + 1e-6)
        left_out[static_cast<std::size_t>(point.index)] = 1;
    ground.radial = sum_of(nominal, fit.difference);
    ground.noise_mm = fit.noise;
    ground.used = static_cast<int>(placed.size());
  }
  double square = 0.0;
  constexpr int kSteps = 400;
  for (int k = 0; k <= kSteps; ++k) {
    const double s = length * k / kSteps, d = ground.radial.at(s).r - nominal.at(s).r;
    square += d * d / (kSteps + 1);
    ground.largest_mm = std::max(ground.largest_mm, std::abs(d));
  }
  ground.rms_mm = std::sqrt(square);
  for (std::size_t k = 0; k < points.size(); ++k)
    if (left_out[k] != 0) ground.outliers.push_back(static_cast<int>(k));
  ground.elsewhere = static_cast<int>(points.size()) - ground.used - static_cast<int>(ground.outliers.size());
  if (ground.largest_mm > kOtherTool * 0.5 * (nominal.smallest() + nominal.largest()))
    refuse(file,
           "its radii differ from the tool's by up to " + std::to_string(ground.largest_mm) +
               " mm: this is the profile of another tool, or z does not count from the centre of the tip's sphere");
  const Legitimacy legitimacy = check_legitimacy(ground.radial);
  if (!legitimacy.legitimate) refuse(file, "this is not a tool: " + legitimacy.reason);
  return ground;
}

}  // namespace flank::internal
