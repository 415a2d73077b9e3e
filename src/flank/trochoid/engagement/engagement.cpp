#include "flank/trochoid/engagement/engagement.h"

#include <algorithm>
#include <array>

#include "flank/base/assert.h"
#include "flank/base/parallel.h"

namespace flank::internal {
namespace {

/// Rows of one task: few enough that two threads end together.
constexpr std::size_t kRowsOfTask = 5;
/// Of the way to the second row: there the first one is measured. A half that goes on where the one before ended has nothing to
/// cut in its very first pose, and all of it right after.
constexpr double kAfterStart = 0.01;
/// Of a step between rows: so long before the end is one more. A half that comes to its side at a tangent engages most just before
/// it is there: between the last two of equal steps that rises and falls by degrees.
constexpr double kBeforeEnd = 0.2;
/// Rows whose neighbourhood is refined, the largest ones.
constexpr std::size_t kPeaks = 3;

/// By the trapezoidal rule, as if the first row were at the start: where rings move from row to row, no row may count more than
/// the next.
double weight(std::size_t row, int rows) {
  const double before = row < 2 ? 0.0 : EngagementMeter::time_of(row - 1, rows);
  const double after = row + 1 < static_cast<std::size_t>(rows) ? EngagementMeter::time_of(row + 1, rows) : 1.0;
  return 0.5 * (after - before);
}

/// The rows that are larger than their neighbours, the largest few.
std::vector<std::size_t> largest_rows(const std::vector<EngagementRow>& rows) {
  const int n = static_cast<int>(rows.size());
  const auto at = [&](int k) { return rows[static_cast<std::size_t>(std::clamp(k, 0, n - 1))].angle_rad; };
  std::vector<std::size_t> order;
  for (int i = 0; i < n; ++i)
    if (at(i) > 0.0 && at(i) >= at(i - 1) && at(i) >= at(i + 1)) order.push_back(static_cast<std::size_t>(i));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rows[a].angle_rad > rows[b].angle_rad; });
  order.resize(std::min(order.size(), kPeaks));
  return order;
}

/// Golden section for the largest value between two places; returns where.
template <class F>
double golden(double low, double high, const F& f) {
  constexpr int kSections = 14;
  constexpr double kGolden = 0.6180339887498949;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low), fa = f(a), fb = f(b);
  for (int k = 0; k < kSections; ++k) {
    if (fa > fb) {
      high = b, b = a, fb = fa;
      fa = f(a = high - kGolden * (high - low));
    } else {
      low = a, a = b, fa = fb;
      fb = f(b = low + kGolden * (high - low));
    }
  }
  return 0.5 * (low + high);
}

}  // namespace

double EngagementMeter::time_of(std::size_t row, int rows) {
  const double steps = rows - 2.0, place = static_cast<double>(row);
  if (row == 0) return kAfterStart / steps;
  if (place < steps) return place / steps;
  return place == steps ? 1.0 - kBeforeEnd / steps : 1.0;
}

void EngagementMeter::reserve(std::size_t count) {
  while (meters_.size() < count) meters_.emplace_back(stock_, near_);
}

template <class RingsOf, class Use>
void EngagementMeter::for_each_row(const RuledMotion& motion, const RingsOf& rings_of, int rows, const Use& use) {
  near_.begin(motion);
  const auto count = static_cast<std::size_t>(rows);
  reserve((count + kRowsOfTask - 1) / kRowsOfTask);
  parallel_blocks(count, kRowsOfTask, [&](std::size_t begin, std::size_t end) {
    RowMeter& meter = meters_[begin / kRowsOfTask];
    meter.begin();
    for (std::size_t i = begin; i < end; ++i) use(i, meter.row(motion, time_of(i, rows), rings_of(i)), meter.found());
  });
}

template <class RingsOf>
Engagement EngagementMeter::measured(const RuledMotion& motion, const RingsOf& rings_of, int rows) {
  FLANK_ASSERT(rows >= 3);
  Engagement out;
  out.rows.resize(static_cast<std::size_t>(rows));
  for_each_row(motion, rings_of, rows,
               [&](std::size_t i, const EngagementRow& row, const auto&) { out.rows[i] = row; });
  for (std::size_t i = 0; i < out.rows.size(); ++i) {
    const EngagementRow& row = out.rows[i];
    if (row.angle_rad > out.peak.angle_rad) out.peak = {row.angle_rad, row.t, row.s};
    out.volume_mm3 += row.rate_mm3 * weight(i, rows);
  }
  return out;
}

Engagement EngagementMeter::measure(const RuledMotion& motion, std::span<const ToolRing> rings, int rows) {
  return measured(
      motion, [&](std::size_t) { return rings; }, rows);
}

Engagement EngagementMeter::measure(const RuledMotion& motion, const RowRings& rings, int rows) {
  return measured(
      motion, [&](std::size_t row) { return rings.of(row); }, rows);
}

void EngagementMeter::measure_rings(const RuledMotion& motion, std::span<const ToolRing> rings, int rows,
                                    std::span<double> angles) {
  FLANK_ASSERT(rows >= 3 && angles.size() == static_cast<std::size_t>(rows) * rings.size());
  std::fill(angles.begin(), angles.end(), 0.0);
  const auto same = [&](std::size_t) { return rings; };
  for_each_row(motion, same, rows, [&](std::size_t i, const EngagementRow&, const std::vector<RingArc>& found) {
    for (const RingArc& arc : found) angles[i * rings.size() + arc.ring] += arc.arc.high - arc.arc.low;
  });
}

double EngagementMeter::angle(const RuledMotion& motion, double t, const ToolRing& ring) {
  near_.begin(motion);
  reserve(1);
  meters_.front().begin();
  return meters_.front().row(motion, t, {&ring, 1}).angle_rad;
}

EngagementPeak EngagementMeter::peak_near(const RuledMotion& motion, const EngagementRow& row, double step, double ds,
                                          RowMeter& meter) const {
  EngagementPeak best;
  meter.begin();
  const double length = motion.axis_length;
  const auto value = [&](double t, double s) {
    const ToolRing ring = ring_at(stock_.radial(), s);
    const double angle = meter.row(motion, t, {&ring, 1}).angle_rad;
    if (angle > best.angle_rad) best = {angle, t, s};
    return angle;
  };
  double t = row.t, s = row.s;
  const auto by_time = [&](double x) { return value(x, s); };
  t = golden(std::max(0.0, t - step), std::min(1.0, t + step), by_time);
  if (s <= 0.0 || s >= length) return best;
  s = golden(std::max(0.0, s - ds), std::min(length, s + ds), [&](double x) { return value(t, x); });
  (void)golden(std::max(0.0, t - 0.5 * step), std::min(1.0, t + 0.5 * step), by_time);
  return best;
}

EngagementPeak EngagementMeter::refine(const RuledMotion& motion, const Engagement& measured, int flank_rings) {
  near_.begin(motion);
  const std::vector<std::size_t> rows = largest_rows(measured.rows);
  reserve(rows.size());
  const double step = 1.0 / (static_cast<double>(measured.rows.size()) - 2.0);
  const double ds = motion.axis_length / (flank_rings - 1);
  std::array<EngagementPeak, kPeaks> peaks;
  parallel_for(rows.size(),
               [&](std::size_t k) { peaks[k] = peak_near(motion, measured.rows[rows[k]], step, ds, meters_[k]); });
  EngagementPeak best = measured.peak;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (peaks[k].angle_rad > best.angle_rad) best = peaks[k];
  return best;
}

}  // namespace flank::internal
