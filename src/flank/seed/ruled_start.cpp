#include "flank/seed/ruled_start.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

constexpr int kSamples = 17;  ///< on a contact line, which is curved once or twice at most
using ContactLine = Eigen::Matrix<double, 3, kSamples>;

/// The skew in chart units: shift of a contact line in the direction of motion from one of its ends to the other, as a
/// share of the way. Clamped, because a contact line that crosses most of the way leaves no room for others beside it.
double skew_share(const Chart& chart, const RuledStart& start) {
  const double across = start.swapped ? chart.length_a() : chart.length_b();
  const double along = start.swapped ? chart.length_b() : chart.length_a();
  constexpr double kMost = 0.6;
  return std::clamp(std::tan(start.skew_rad) * across / along, -kMost, kMost);
}

/// The contact line, moved off by the tool's radius.
void offset(const RuledStart& start, const ContactLine& normals, ContactLine& line) {
  std::array<double, kSamples> way;  // mm, from the low end
  way[0] = 0.0;
  for (int k = 1; k < kSamples; ++k) way[k] = way[k - 1] + (line.col(k) - line.col(k - 1)).norm();
  for (int k = 0; k < kSamples; ++k) {
    const double from_tip = start.tip_high ? way[kSamples - 1] - way[k] : way[k];
    // The way on the surface is shorter than that on the axis by the cosine.
    line.col(k) += (start.radius_mm + std::tan(start.lean_rad) * from_tip) * normals.col(k);
  }
}

}  // namespace

double radius_at(const RuledStart& start, double from_tip_mm) {
  return start.radius_mm + std::sin(start.lean_rad) * std::max(0.0, from_tip_mm);
}

FittedLine axis_line(const Chart& chart, const RuledStart& start, double t) {
  constexpr double kPastEnd = 0.04;  // of the way: first and last line together lie this much past the border
  const double skew = skew_share(chart, start);
  // A skewed line sweeps the corners of the chart only if it starts before it and ends behind it.
  const double reach = 1.0 + std::abs(skew) * (start.band_high - start.band_low) + kPastEnd;
  const double middle = 0.5 * (start.band_low + start.band_high);
  ContactLine q, normals;
  for (int k = 0; k < kSamples; ++k) {
    const double b = start.band_low + (start.band_high - start.band_low) * k / (kSamples - 1);
    const double a = 0.5 + reach * (t - 0.5) + skew * (b - middle);
    const ChartPoint at = start.swapped ? chart.at(b, a) : chart.at(a, b);
    q.col(k) = at.point;
    normals.col(k) = at.normal;
  }
  offset(start, normals, q);
  // Total least squares: the direction of the largest spread.
  const Vec3 mean = q.rowwise().mean();
  const ContactLine centred = q.colwise() - mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(centred * centred.transpose());
  Vec3 u = eigen.eigenvectors().col(2);
  // An eigenvector has no sign: along increasing b, so that neighbouring times agree.
  if (u.dot(q.col(kSamples - 1) - q.col(0)) < 0.0) u = -u;
  const Eigen::Matrix<double, 1, kSamples> along = u.transpose() * centred;
  return {mean + 0.5 * (along.minCoeff() + along.maxCoeff()) * u, u, along.maxCoeff() - along.minCoeff()};
}

double longest_chord(const Chart& chart, const RuledStart& start) {
  double longest = 0.0;
  for (int i = 0; i < kStartTimes; ++i)
    longest = std::max(longest, axis_line(chart, start, i / (kStartTimes - 1.0)).length);
  return longest;
}

RuledMotion make_motion(const Chart& chart, const RuledStart& start, double axis_length, int count) {
  FLANK_ASSERT(axis_length > 0.0 && count >= 4);
  std::vector<Pose> poses;
  std::vector<double> times;
  for (int i = 0; i < kStartTimes; ++i) {
    const double t = i / (kStartTimes - 1.0);
    const FittedLine line = axis_line(chart, start, start.first + (start.last - start.first) * t);
    const Vec3 u = start.tip_high ? Vec3(-line.direction) : line.direction;
    poses.push_back({line.middle - 0.5 * (start.lean_rad != 0.0 ? line.length : axis_length) * u, u});
    times.push_back(t);
  }
  return fit_motion(poses, times, axis_length, count);
}

}  // namespace flank::internal
