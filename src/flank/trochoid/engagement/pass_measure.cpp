#include "flank/trochoid/engagement/pass_measure.h"

#include <algorithm>
#include <cmath>

#include "flank/trochoid/engagement/engagement.h"

namespace flank::internal {
namespace {

constexpr int kRows = 202, kRings = 21, kVolumeRings = 9;

RuledMotion straight(const Pose& from, const Pose& to, double axis_length) {
  constexpr int kPoints = 4;
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int k = 0; k < kPoints; ++k) {
    t.push_back(k / (kPoints - 1.0));
    poses.push_back({from.tip + t.back() * (to.tip - from.tip), from.axis + t.back() * (to.axis - from.axis)});
  }
  return fit_motion(poses, t, axis_length, kPoints);
}

}  // namespace

PassMeasure measure_pass(const std::vector<RuledMotion>& motions, int sweep_intervals, SweptStock& stock) {
  EngagementMeter meter(stock);
  const RowRings rings(stock.radial(), kRings, kVolumeRings);
  PassMeasure out;
  for (const RuledMotion& motion : motions) {
    const Engagement e = meter.measure(motion, rings, kRows);
    out.volume_mm3 += e.volume_mm3;
    out.largest_rad = std::max(out.largest_rad, meter.refine(motion, e, kRings).angle_rad);
    stock.add(Sweep::of(motion, sweep_intervals));
  }
  return out;
}

double largest_engagement(const std::vector<Pose>& way, const SweptStock& stock) {
  constexpr int kLeastRows = 5;
  constexpr double kRowsARadius = 8.0;
  const double length = stock.radial().axis_length();
  EngagementMeter meter(stock);
  const RowRings rings(stock.radial(), kRings, kVolumeRings);
  double largest = 0.0;
  for (std::size_t k = 1; k < way.size(); ++k) {
    const double far =
        std::max((way[k].at(0.0) - way[k - 1].at(0.0)).norm(), (way[k].at(length) - way[k - 1].at(length)).norm());
    if (!(far > 0.0)) continue;
    const int rows = std::max(kLeastRows, static_cast<int>(std::ceil(kRowsARadius * far / stock.radial().smallest())));
    largest = std::max(largest, meter.measure(straight(way[k - 1], way[k], length), rings, rows).peak.angle_rad);
  }
  return largest;
}

}  // namespace flank::internal
