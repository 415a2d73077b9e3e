#include "flank/trochoid/engagement/pass_measure.h"

#include <algorithm>

#include "flank/trochoid/engagement/engagement.h"

namespace flank::internal {
namespace {

constexpr int kRows = 202, kRings = 21, kVolumeRings = 9;

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

}  // namespace flank::internal
