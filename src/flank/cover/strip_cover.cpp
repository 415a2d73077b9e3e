#include "flank/cover/strip_cover.h"

#include <algorithm>
#include <cmath>

#include "flank/envelope/swept_estimate.h"

namespace flank {
namespace {

constexpr int kLeastControlPoints = 6;
constexpr int kPosesPerControlPoint = 5;

int table_poses(const RuledMotion& motion) { return std::max(40, kPosesPerControlPoint * motion.tip.count()); }

/// Box of the swept tool.
Box3 swept_box(const RuledMotion& motion, const RadialFunction& radial, double margin, int poses) {
  Box3 box;
  for (int i = 0; i <= poses; ++i) {
    const Pose pose = motion.pose(static_cast<double>(i) / poses);
    box.add(pose.tip);
    box.add(pose.at(motion.axis_length));
  }
  double largest = 0.0;
  for (int j = 0; j <= 32; ++j) largest = std::max(largest, radial.at(motion.axis_length * j / 32.0).r);
  box.low.array() -= largest + margin;
  box.high.array() += largest + margin;
  return box;
}

SweptContact contact(const SweptEstimate& swept, const RuledMotion& motion, const RadialFunction& radial,
                     const Vec3& x, double tolerance_mm) {
  SweptContact near = swept.nearest(x);
  // The estimate ranks; what would count as overcut, or as just within tolerance, is looked at closely.
  if (std::abs(std::abs(near.f) - tolerance_mm) < 0.3 * tolerance_mm || near.f < -0.5 * tolerance_mm) {
    const double t = near.t;
    near = refine_contact(motion, radial, x, t, swept.spacing());
  }
  return near;
}

}  // namespace

CoverSamples cover_samples(const Target& target, double spacing_mm) {
  CoverSamples samples;
  samples.cells = target.samples(spacing_mm);
  samples.border = target.border_points(spacing_mm / 3.0);
  for (const SurfaceSample& cell : samples.cells) samples.area += cell.area;
  return samples;
}

RuledMotion motion_through(const std::vector<Pose>& poses, double axis_length, int control_points) {
  std::vector<Pose> dense;
  std::vector<double> chord = {0.0}, t;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i)
    chord.push_back(chord.back() + 0.5 * ((poses[i + 1].tip - poses[i].tip).norm() +
                                          (poses[i + 1].at(axis_length) - poses[i].at(axis_length)).norm()));
  const int count = std::clamp(static_cast<int>(poses.size()), kLeastControlPoints, control_points);
  // Few poses leave control points without data: the joined poses give more.
  const int between = std::max(1, static_cast<int>(std::ceil(2.0 * count / static_cast<double>(poses.size()))));
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    for (int k = 0; k < between; ++k) {
      const double f = static_cast<double>(k) / between;
      dense.push_back({poses[i].tip + f * (poses[i + 1].tip - poses[i].tip),
                       (poses[i].axis + f * (poses[i + 1].axis - poses[i].axis)).normalized()});
      t.push_back((chord[i] + f * (chord[i + 1] - chord[i])) / chord.back());
    }
  }
  dense.push_back(poses.back());
  t.push_back(1.0);
  return fit_motion(dense, t, axis_length, std::min(count, static_cast<int>(dense.size())));
}

CoverStrip measure_strip(const CoverSamples& samples, RuledMotion motion, const RadialFunction& radial,
                         double tolerance_mm) {
  CoverStrip strip;
  const int poses = table_poses(motion);
  const Box3 box = swept_box(motion, radial, tolerance_mm, poses);
  const SweptEstimate swept({motion}, radial, poses);
  for (std::size_t k = 0; k < samples.cells.size(); ++k) {
    const SurfaceSample& cell = samples.cells[k];
    if (box.squared_distance(cell.point) > 0.0) continue;
    const double f = contact(swept, motion, radial, cell.point, tolerance_mm).f;
    strip.overcut_mm = std::max(strip.overcut_mm, -f);
    if (std::abs(f) > tolerance_mm) continue;
    strip.cells.push_back(static_cast<int>(k));
    strip.area += cell.area;
  }
  for (const Vec3& x : samples.border)
    if (box.squared_distance(x) == 0.0)
      strip.overcut_mm = std::max(strip.overcut_mm, -contact(swept, motion, radial, x, tolerance_mm).f);
  strip.motion = std::move(motion);
  return strip;
}

RuledMotion part_of_motion(const RuledMotion& motion, double t0, double t1) {
  constexpr int kSamples = 160;
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int i = 0; i <= kSamples; ++i) {
    t.push_back(static_cast<double>(i) / kSamples);
    poses.push_back(motion.pose(t0 + t.back() * (t1 - t0)));
  }
  return fit_motion(poses, t, motion.axis_length, motion.tip.count());
}

CoverStrip without_overcut_stretches(const CoverSamples& samples, CoverStrip strip, const RadialFunction& radial,
                                     double tolerance_mm) {
  constexpr int kTries = 4;
  constexpr double kMargin = 0.02, kShortest = 0.1;
  const double limit = kCertifiedShare * tolerance_mm;
  for (int k = 0; k < kTries && strip.overcut_mm > limit; ++k) {
    const SweptEstimate swept({strip.motion}, radial, table_poses(strip.motion));
    std::vector<double> bad = {-kMargin, 1.0 + kMargin};
    const auto look = [&](const Vec3& x) {
      const SweptContact at = contact(swept, strip.motion, radial, x, tolerance_mm);
      if (at.f < -limit) bad.push_back(at.t);
    };
    for (const SurfaceSample& cell : samples.cells) look(cell.point);
    for (const Vec3& x : samples.border) look(x);
    std::sort(bad.begin(), bad.end());
    std::size_t widest = 0;
    for (std::size_t i = 0; i + 1 < bad.size(); ++i)
      if (bad[i + 1] - bad[i] > bad[widest + 1] - bad[widest]) widest = i;
    const double t0 = bad[widest] + kMargin, t1 = bad[widest + 1] - kMargin;
    if (t1 - t0 < kShortest) return {};
    strip = measure_strip(samples, part_of_motion(strip.motion, t0, t1), radial, tolerance_mm);
  }
  return strip.overcut_mm > limit ? CoverStrip{} : strip;
}

}  // namespace flank
