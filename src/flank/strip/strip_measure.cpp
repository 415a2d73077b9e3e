#include "flank/strip/strip_measure.h"

#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"
#include "flank/base/tolerance_budget.h"
#include "flank/envelope/swept_estimate.h"

namespace flank::internal {
namespace {

constexpr int kLeastControlPoints = 4;  ///< of a cubic
/// Poses to which the rails are fitted, per control point: enough that least squares smooths the joints and every knot
/// span has several poses to hold it.
constexpr int kSamplesPerControlPoint = 4;
/// Poses of the table of the swept estimate, per control point and at least. The estimate's error is of third order in
/// their spacing, and contacts that matter are refined: see contact().
constexpr int kPosesPerControlPoint = 5, kLeastTablePoses = 40;
/// Shares of the tolerance: a contact is refined if the estimate of |f| is nearer than the first to the tolerance, or f
/// below minus the second. Elsewhere the estimate's own error cannot change whether a cell counts, nor a depth that
/// matters (TargetDepthBudget::remembered).
constexpr double kRefineBand = 0.3, kRefineDepth = 0.5;
/// Samples of the part of a motion that is kept: with at most 48 control points, three or more for each.
constexpr int kPartSamples = 160;

int table_poses(const RuledMotion& motion) {
  return std::max(kLeastTablePoses, kPosesPerControlPoint * motion.tip.count());
}

/// Box of the swept tool.
Box3 swept_box(const RuledMotion& motion, const RadialFunction& radial, double margin, int poses) {
  Box3 box;
  for (int i = 0; i <= poses; ++i) {
    const Pose pose = motion.pose(static_cast<double>(i) / poses);
    box.add(pose.tip);
    box.add(pose.at(motion.axis_length));
  }
  const double reach = radial.largest() + margin;
  box.low.array() -= reach;
  box.high.array() += reach;
  return box;
}

/// Slope at x[i] of the parabola through three neighbours.
Vec3 slope(const std::vector<Vec3>& x, const std::vector<double>& t, std::size_t i) {
  const std::size_t m = std::clamp<std::size_t>(i, 1, t.size() - 2);
  const double a = t[m] - t[m - 1], b = t[m + 1] - t[m];
  const Vec3 left = (x[m] - x[m - 1]) / a, right = (x[m + 1] - x[m]) / b, bend = (right - left) / (a + b);
  return left + (2.0 * t[i] - t[m] - t[m - 1]) * bend;
}

/// Cubic Hermite curve through points at times t, slopes from parabolas.
Vec3 hermite(const std::vector<Vec3>& x, const std::vector<double>& t, std::size_t i, double at) {
  const double h = t[i + 1] - t[i], f = (at - t[i]) / h, g = 1.0 - f;
  return g * g * (1.0 + 2.0 * f) * x[i] + f * f * (1.0 + 2.0 * g) * x[i + 1] +
         h * f * g * (g * slope(x, t, i) - f * slope(x, t, i + 1));
}

/// How much nearer than at the tabulated poses a sphere may come to a point between two of them, mm. A centre that
/// passes at the distance r, with the nearest tabulated place x away along its path, is sqrt(r^2 + x^2) - r <= x^2 / (2
/// r) nearer there. x is at most half a stride; the whole one is used, as paths bend.
double table_slack(const RuledMotion& motion, const RadialFunction& radial) {
  const int poses = table_poses(motion);
  double stride = 0.0;
  for (int i = 0; i + 1 < poses; ++i) {
    const Pose a = motion.pose(static_cast<double>(i) / (poses - 1)), b = motion.pose((i + 1.0) / (poses - 1));
    stride = std::max({stride, (b.tip - a.tip).norm(), (b.at(motion.axis_length) - a.at(motion.axis_length)).norm()});
  }
  return stride * stride / (2.0 * radial.smallest());
}

SweptContact contact(const SweptEstimate& swept, const Vec3& x, double tolerance_mm) {
  const SweptContact near = swept.nearest(x);
  // The estimate ranks; what would count as overcut, or as just within tolerance, is refined.
  const bool counts =
      std::abs(std::abs(near.f) - tolerance_mm) < kRefineBand * tolerance_mm || near.f < -kRefineDepth * tolerance_mm;
  return counts ? swept.refine(x, near) : near;
}

}  // namespace

CoverSamples cover_samples(const Target& target, double spacing_mm) {
  FLANK_ASSERT(spacing_mm > 0.0);
  CoverSamples samples;
  /// Of the cells' spacing. Ridges of f at the border are narrow along it, and points on a curve cost little.
  constexpr double kBorderShare = 0.25;
  samples.cells = target.samples(spacing_mm);
  samples.border = target.border_points(kBorderShare * spacing_mm);
  for (const SurfaceSample& cell : samples.cells) samples.area += cell.area;
  return samples;
}

RuledMotion motion_through(const std::vector<Pose>& poses, double axis_length, int control_points) {
  FLANK_ASSERT(poses.size() >= 5);
  std::vector<Vec3> tips, axes;
  std::vector<double> t = {0.0};
  for (std::size_t i = 0; i + 1 < poses.size(); ++i)
    t.push_back(t.back() + 0.5 * ((poses[i + 1].tip - poses[i].tip).norm() +
                                  (poses[i + 1].at(axis_length) - poses[i].at(axis_length)).norm()));
  for (std::size_t i = 1; i + 1 < t.size(); ++i) t[i] /= t.back();
  t.back() = 1.0;
  for (const Pose& pose : poses) {
    tips.push_back(pose.tip);
    axes.push_back(pose.axis);
  }
  // The steps of a strip differ in length, the knots do not: the poses are joined by cubics first.
  const int count = std::clamp(static_cast<int>(poses.size()), kLeastControlPoints, control_points);
  const int samples = kSamplesPerControlPoint * count;
  std::vector<Pose> even;
  std::vector<double> times;
  for (int i = 0; i <= samples; ++i) {
    times.push_back(static_cast<double>(i) / samples);
    const auto after = std::upper_bound(t.begin() + 1, t.end() - 1, times.back());
    const auto k = static_cast<std::size_t>(after - t.begin()) - 1;
    even.push_back({hermite(tips, t, k, times.back()), hermite(axes, t, k, times.back()).normalized()});
  }
  return fit_motion(even, times, axis_length, count);
}

int depth_poses(const RuledMotion& motion) {
  // A knot span has at most about one wave; of that, samples an eighth apart miss 2 sin^2(pi/16) = 8 % of the height at
  // most. 384 are those of 48 control points, the most that smoothed rails have by default; more would only cost time.
  constexpr int kPerControlPoint = 8, kMost = 384;
  return std::min(kPerControlPoint * motion.tip.count(), kMost);
}

namespace {

/// Tolerances: a border point whose estimated f is above this, and above what the table may miss, cannot be too deep.
constexpr double kBorderBand = 2.0;

/// Depths by the spheres of the axis: inside the target only, which is cheap. What happens past the border is seen from
/// the points of the border (measure_border).
void measure_axis(CoverStrip& strip, LineFitter& fitter) {
  const int poses = depth_poses(strip.motion);
  fitter.forget();
  for (int i = 0; i <= poses; ++i) {
    (void)fitter.measure(strip.motion.pose(static_cast<double>(i) / poses));
    strip.depths.push_back(fitter.inside_overcut());
  }
}

/// Counts a contact at a point of the target, with all its fields, among the depths.
void count_contact(CoverStrip& strip, const SweptContact& at, double tolerance_mm) {
  const auto steps = static_cast<double>(strip.depths.size() - 1);
  double& depth = strip.depths[static_cast<std::size_t>(std::lround(at.t * steps))];
  depth = std::max(depth, -at.f);
  if (at.f < -kToleranceBudget.target.remembered * tolerance_mm) strip.deep.push_back(at);
}

void measure_border(const CoverSamples& samples, const SweptEstimate& swept, const Box3& box,
                    const RadialFunction& radial, double tolerance_mm, CoverStrip& strip) {
  const double slack = kBorderBand * tolerance_mm + table_slack(strip.motion, radial);
  for (const Vec3& x : samples.border) {
    if (box.squared_distance(x) > 0.0) continue;
    const SweptContact at = swept.nearest(x);
    if (at.f > slack) continue;
    count_contact(strip, swept.refine(x, at), tolerance_mm);
  }
}

}  // namespace

CoverStrip measure_strip(const CoverSamples& samples, RuledMotion motion, const RadialFunction& radial,
                         LineFitter& fitter) {
  CoverStrip strip;
  strip.motion = std::move(motion);
  const double tolerance = fitter.options().tolerance_mm;
  const int poses = table_poses(strip.motion);
  const Box3 box = swept_box(strip.motion, radial, tolerance, poses);
  const SweptEstimate swept({strip.motion}, radial, poses);
  measure_axis(strip, fitter);
  for (std::size_t k = 0; k < samples.cells.size(); ++k) {
    const SurfaceSample& cell = samples.cells[k];
    if (box.squared_distance(cell.point) > 0.0) continue;
    const SweptContact at = contact(swept, cell.point, tolerance);
    if (at.f < -kToleranceBudget.target.remembered * tolerance) count_contact(strip, at, tolerance);
    if (std::abs(at.f) > tolerance) continue;
    strip.cells.push_back(static_cast<int>(k));
    strip.area += cell.area;
  }
  measure_border(samples, swept, box, radial, tolerance, strip);
  strip.overcut_mm = std::max(0.0, *std::max_element(strip.depths.begin(), strip.depths.end()));
  return strip;
}

RuledMotion part_of_motion(const RuledMotion& motion, double t0, double t1) {
  FLANK_ASSERT(0.0 <= t0 && t0 < t1 && t1 <= 1.0);
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int i = 0; i <= kPartSamples; ++i) {
    t.push_back(static_cast<double>(i) / kPartSamples);
    poses.push_back(motion.pose(t0 + t.back() * (t1 - t0)));
  }
  return fit_motion(poses, t, motion.axis_length, motion.tip.count());
}

}  // namespace flank::internal
