#include "flank/seed/guide_start.h"

#include <algorithm>
#include <cmath>

#include "flank/error.h"
#include "flank/seed/movability.h"

namespace flank::internal {
namespace {

/// Intervals at which the two rails are sampled: many for each of a guide's lines (tens) and of the motion's control
/// points (24), so that the motion is that of the rails, not of the samples.
constexpr int kDense = 400;
/// An axis shorter than this share of the guide's mean length has no direction worth following.
constexpr double kShortest = 0.05;
/// A guide whose travel is below this share of its axis' length stands still.
constexpr double kLeastTravel = 1e-6;

/// The ends of the lines as control polygon: the rail begins and ends at the guide's first and last line and smooths
/// what is between. Two or three lines allow degree one or two only.
BSplineCurve3 rail(const std::vector<AxisLine>& lines, bool holder) {
  BSplineCurve3 curve;
  const int count = static_cast<int>(lines.size());
  curve.degree = std::min(3, count - 1);
  curve.knots = uniform_knots(curve.degree, count);
  curve.poles.resize(3, count);
  for (int k = 0; k < count; ++k) {
    const AxisLine& line = lines[static_cast<std::size_t>(k)];
    curve.poles.col(k) = holder ? line.holder : line.tip;
  }
  return curve;
}

}  // namespace

GuideStart start_from_guide(const std::string& file, const std::vector<AxisLine>& lines,
                            std::optional<double> axis_length_mm, int control_points) {
  const BSplineCurve3 tip = rail(lines, false), holder = rail(lines, true);
  std::vector<Vec3> tips, arms;
  std::vector<double> travel{0.0};
  GuideStart out;
  for (int i = 0; i <= kDense; ++i) {
    const double t = static_cast<double>(i) / kDense;
    tips.push_back(tip.value(t));
    arms.push_back(holder.value(t) - tips.back());
    out.mean_length_mm += arms.back().norm() / (kDense + 1);
    if (i == 0) continue;
    // Travel of the middle of the axis: of a fan, one end travels farther and the other stands still.
    const Vec3 tip_step = tips.back() - tips[tips.size() - 2];
    travel.push_back(travel.back() + (tip_step + 0.5 * (arms.back() - arms[arms.size() - 2])).norm());
  }
  if (!std::isfinite(travel.back()) || !std::isfinite(out.mean_length_mm))
    throw InputError(file + ": the lines of the guide are too long or too far apart to be measured");
  for (const Vec3& arm : arms)
    if (arm.norm() < kShortest * out.mean_length_mm)
      throw InputError(file +
                       ": the axis turns over between two lines of the guide; give more lines, all from tip to holder");
  if (travel.back() < kLeastTravel * out.mean_length_mm)
    throw InputError(file + ": the lines of the guide lie at the same place");

  const double length = axis_length_mm.value_or(out.mean_length_mm);
  // Equal steps of travel, not of the guide's parameter: the samples of a fit are equally spaced in time.
  std::vector<Pose> poses;
  std::vector<double> times;
  for (std::size_t i = 0; i < tips.size(); ++i) {
    out.largest_stretch_mm = std::max(out.largest_stretch_mm, std::abs(arms[i].norm() - length));
    poses.push_back({tips[i], arms[i].normalized()});
    times.push_back(travel[i] / travel.back());
  }
  out.motion = fit_motion(poses, times, length, control_points);
  return out;
}

int side_of_motion(const Target& target, const RuledMotion& motion) {
  // A vote: the sum of distances is far from zero on the right motion's side, so a coarse grid decides as well as a
  // fine one.
  constexpr int kTimes = 9, kPlaces = 12;
  std::vector<Footpoint> feet(kPlaces);
  double sum = 0.0;
  for (int i = 0; i < kTimes; ++i) {
    for (Footpoint& foot : feet) foot.patch = -1;  // times are far apart: no hints from the last one
    track_axis(target, motion.pose((i + 0.5) / kTimes), motion.axis_length, feet);
    for (const Footpoint& foot : feet) sum += footpoint_weight(foot.location) * foot.distance;
  }
  return sum < 0.0 ? -1 : 1;
}

}  // namespace flank::internal
