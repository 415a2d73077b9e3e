#include "flank/seed/chart.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

/// Samples of the target from which the chart is made: 40 a side, about as many as there are nodes.
constexpr double kSamples = 1600.0;
/// Against a division by zero where the target has no extent in a direction, or all neighbours are one point.
constexpr double kTiny = 1e-300;

/// Plane coordinates of every sample, scaled to the unit square.
std::vector<Vec2> plane_coordinates(const Target& target, const std::vector<SurfaceSample>& samples) {
  std::vector<Vec2> plane;
  // Parameters of one face follow its shape even if it is bent to a tube; of several faces there are none in common,
  // and the plane of the two largest spreads has to do.
  if (target.patch_count() == 1) {
    for (const SurfaceSample& s : samples) plane.emplace_back(s.u, s.v);
  } else {
    Vec3 mean = Vec3::Zero();
    for (const SurfaceSample& s : samples) mean += s.point;
    mean /= static_cast<double>(samples.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const SurfaceSample& s : samples) spread += (s.point - mean) * (s.point - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(spread);
    const Vec3 a = eigen.eigenvectors().col(2), b = eigen.eigenvectors().col(1);
    for (const SurfaceSample& s : samples) plane.emplace_back(a.dot(s.point - mean), b.dot(s.point - mean));
  }
  Vec2 low = plane.front(), high = plane.front();
  for (const Vec2& p : plane) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  // Samples are cell centres: the border lies half a cell further out.
  const double cell = 0.5 / std::sqrt(static_cast<double>(samples.size()));
  for (Vec2& p : plane) {
    for (int k = 0; k < 2; ++k) p[k] = cell + (1.0 - 2.0 * cell) * (p[k] - low[k]) / std::max(kTiny, high[k] - low[k]);
  }
  return plane;
}

/// Local linear regression of the points over the plane, at q.
Vec3 regress(const std::vector<Vec2>& plane, const std::vector<SurfaceSample>& samples, const Vec2& q,
             std::size_t& nearest) {
  constexpr std::size_t kNeighbours = 12;  // four times the unknowns: a ring or two around q, one-sided at the border
  constexpr double kNearest = 0.05;        // of the farthest squared distance: bounds the weight at a sample
  constexpr double kRidge = 1e-9;          // keeps three neighbours on one line solvable
  std::vector<std::pair<double, std::size_t>> order(plane.size());
  for (std::size_t i = 0; i < plane.size(); ++i) order[i] = {(plane[i] - q).squaredNorm(), i};
  const std::size_t count = std::min(kNeighbours, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end());
  nearest = order.front().second;
  const double scale = order[count - 1].first + kTiny;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Identity() * kRidge;
  Eigen::Matrix3d rhs = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = order[k].second;
    const double w = 1.0 / (kNearest + order[k].first / scale);
    const Vec3 row(1.0, (plane[i] - q)[0], (plane[i] - q)[1]);
    normal += w * row * row.transpose();
    rhs += w * row * samples[i].point.transpose();
  }
  return normal.ldlt().solve(rhs).row(0).transpose();
}

}  // namespace

Chart::Chart(const Target& target) {
  const std::vector<SurfaceSample> samples = target.samples(std::sqrt(target.area() / kSamples));
  const std::vector<Vec2> plane = plane_coordinates(target, samples);
  std::vector<Footpoint> hints(samples.size());
  nodes_.resize(kNodes * kNodes);
  for (int i = 0; i < kNodes; ++i) {
    for (int j = 0; j < kNodes; ++j) {
      const Vec2 q(-kOverrun + (1.0 + 2.0 * kOverrun) * i / (kNodes - 1),
                   -kOverrun + (1.0 + 2.0 * kOverrun) * j / (kNodes - 1));
      // The regression comes near the surface, the footpoint lies on it; warm from the nearest sample's, so that it
      // stays on this sheet of the target, and past the border on its extension.
      std::size_t nearest = 0;
      const Vec3 p = regress(plane, samples, q, nearest);
      if (hints[nearest].patch < 0) hints[nearest] = target.closest(samples[nearest].point);
      const Footpoint foot = target.track(p, hints[nearest]);
      nodes_[static_cast<std::size_t>(i * kNodes + j)] = {foot.point, foot.normal};
    }
  }
  measure();
}

Chart::Chart(const std::function<ChartPoint(double a, double b)>& point_at) {
  for (int i = 0; i < kNodes; ++i)
    for (int j = 0; j < kNodes; ++j)
      nodes_.push_back(point_at(-kOverrun + (1.0 + 2.0 * kOverrun) * i / (kNodes - 1),
                                -kOverrun + (1.0 + 2.0 * kOverrun) * j / (kNodes - 1)));
  measure();
}

void Chart::measure() {
  // Lengths of polylines: they turn a skew in degrees into one of the chart, for which a percent is plenty.
  constexpr int kLines = 8, kSteps = 16;
  for (int k = 0; k < kLines; ++k) {
    const double b = (k + 0.5) / kLines;
    for (int i = 0; i < kSteps; ++i) {
      length_a_ += (at((i + 1.0) / kSteps, b).point - at(static_cast<double>(i) / kSteps, b).point).norm() / kLines;
      length_b_ += (at(b, (i + 1.0) / kSteps).point - at(b, static_cast<double>(i) / kSteps).point).norm() / kLines;
    }
  }
}

ChartPoint Chart::at(double a, double b) const {
  FLANK_ASSERT(std::isfinite(a) && std::isfinite(b));
  const double x = (a + kOverrun) / (1.0 + 2.0 * kOverrun) * (kNodes - 1);
  const double y = (b + kOverrun) / (1.0 + 2.0 * kOverrun) * (kNodes - 1);
  const int i = std::clamp(static_cast<int>(std::floor(x)), 0, kNodes - 2);
  const int j = std::clamp(static_cast<int>(std::floor(y)), 0, kNodes - 2);
  const double f = x - i, g = y - j;
  const auto node = [&](int di, int dj) -> const ChartPoint& {
    return nodes_[static_cast<std::size_t>((i + di) * kNodes + j + dj)];
  };
  const double w[4] = {(1 - f) * (1 - g), (1 - f) * g, f * (1 - g), f * g};
  ChartPoint out;
  out.point = w[0] * node(0, 0).point + w[1] * node(0, 1).point + w[2] * node(1, 0).point + w[3] * node(1, 1).point;
  // Normals do not extrapolate well: beyond the chart the border's is kept.
  const double fn = std::clamp(f, 0.0, 1.0), gn = std::clamp(g, 0.0, 1.0);
  out.normal = ((1 - fn) * (1 - gn) * node(0, 0).normal + (1 - fn) * gn * node(0, 1).normal +
                fn * (1 - gn) * node(1, 0).normal + fn * gn * node(1, 1).normal)
                   .normalized();
  return out;
}

}  // namespace flank::internal
