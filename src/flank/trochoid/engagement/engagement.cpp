#include "flank/trochoid/engagement/engagement.h"

#include <algorithm>
#include <array>
#include <cmath>

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

/// Golden section for the largest value between two places; `f` keeps what it saw.
template <class F>
void golden(double low, double high, const F& f) {
  constexpr int kSections = 8;
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
}

/// Around a large row, in steps between rows: there its ridge is looked for.
constexpr double kBeside = 1.5;
/// Crests of a ridge that are climbed, the highest ones, and the rings by which they are looked for, at least.
constexpr std::size_t kClimbs = 3;
constexpr int kLeastRings = 7;

RidgeWindow within_motion(RidgeWindow window, double length) {
  window.t_low = std::clamp(window.t_low, kFirstTime, 1.0);
  window.t_high = std::clamp(window.t_high, kFirstTime, 1.0);
  window.s_low = std::max(0.0, window.s_low);
  window.s_high = std::min(length, window.s_high);
  return window;
}

/// A crest of some ridge.
struct Top {
  double angle_rad;
  RidgeWindow window;
};

/// The highest crests of all ridges.
std::vector<Top> highest_of(std::span<const Ridge> ridges) {
  std::vector<Top> tops;
  for (const Ridge& ridge : ridges)
    for (const std::size_t ring : ridge.tops()) tops.push_back({ridge.crests[ring].angle_rad, ridge.around(ring)});
  std::stable_sort(tops.begin(), tops.end(), [](const Top& a, const Top& b) { return a.angle_rad > b.angle_rad; });
  tops.resize(std::min(tops.size(), kClimbs));
  return tops;
}

/// Of a pass.
constexpr int kPassRings = 21, kPassVolumeRings = 9;

/// From one pose to the other, evenly.
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
  sum(out);
  return out;
}

void EngagementMeter::sum(Engagement& measured) {
  for (std::size_t i = 0; i < measured.rows.size(); ++i) {
    const EngagementRow& row = measured.rows[i];
    if (row.angle_rad > measured.peak.angle_rad) measured.peak = {row.angle_rad, row.t, row.s};
    measured.volume_mm3 += row.rate_mm3 * weight(i, static_cast<int>(measured.rows.size()));
  }
}

Engagement EngagementMeter::measure(const RuledMotion& motion, std::span<const ToolRing> rings, int rows) {
  return measured(
      motion, [&](std::size_t) { return rings; }, rows);
}

Engagement EngagementMeter::measure(const RuledMotion& motion, const RowRings& rings, int rows) {
  return measured(
      motion, [&](std::size_t row) { return rings.of(row); }, rows);
}

Engagement EngagementMeter::measure_peak(const RuledMotion& motion, const RowRings& rings, int rows, double guess,
                                         double least_rad) {
  FLANK_ASSERT(rows >= 3);
  Engagement out;
  const auto count = static_cast<std::size_t>(rows);
  out.rows.resize(count);
  near_.begin(motion);
  const std::size_t tasks = (count + kRowsOfTask - 1) / kRowsOfTask;
  reserve(tasks + 1);
  const auto first = static_cast<std::size_t>(std::lround(std::clamp(guess, 0.0, 1.0) * (rows - 2.0)));
  const auto ask = [&](RowMeter& meter, std::size_t i, double least) {
    out.rows[i] = meter.row(motion, time_of(i, rows), rings.of(i), least);
    return std::max(least, out.rows[i].angle_rad);
  };
  meters_[tasks].begin();
  const double least = ask(meters_[tasks], first, least_rad);
  parallel_blocks(count, kRowsOfTask, [&](std::size_t begin, std::size_t end) {
    RowMeter& meter = meters_[begin / kRowsOfTask];
    meter.begin_after(meters_[tasks]);
    double here = least;
    for (std::size_t i = begin; i < end; ++i)
      if (i != first) here = ask(meter, i, here);
  });
  sum(out);
  return out;
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

Ridge EngagementMeter::ridge_in(const RuledMotion& motion, const RidgeWindow& window, int rings, RowMeter& meter,
                                EngagementPeak& best) const {
  std::vector<ToolRing> asked;
  for (int k = 0; k < rings; ++k)
    asked.push_back(ring_at(stock_.radial(), std::lerp(window.s_low, window.s_high, k / (rings - 1.0))));
  const double step = (window.t_high - window.t_low) / (kRidgeTimes - 1.0);
  std::vector<RingTimes> angles(asked.size(), RingTimes{});
  for (std::size_t i = 0; i < kRidgeTimes; ++i) {
    const EngagementRow row = meter.row(motion, window.t_low + static_cast<double>(i) * step, asked);
    for (const RingArc& arc : meter.found()) angles[arc.ring][i] += arc.arc.high - arc.arc.low;
    if (row.angle_rad > best.angle_rad) best = {row.angle_rad, row.t, row.s};
  }
  Ridge out{window, {}};
  for (const RingTimes& of_ring : angles) out.crests.push_back(crest_of(of_ring, window.t_low, step));
  return out;
}

EngagementPeak EngagementMeter::climb(const RuledMotion& motion, RidgeWindow window, RowMeter& meter) const {
  constexpr int kLooks = 3, kRings = 9;
  EngagementPeak best;
  double s = 0.0;
  meter.begin();
  for (int look = 0; look < kLooks; ++look) {
    const Ridge ridge = ridge_in(motion, within_motion(window, motion.axis_length), kRings, meter, best);
    const std::vector<std::size_t> tops = ridge.tops();
    if (tops.empty()) return best;
    window = ridge.around(tops.front());
    s = ridge.s_of(tops.front());
  }
  window = within_motion(window, motion.axis_length);
  const ToolRing ring = ring_at(stock_.radial(), s);
  golden(window.t_low, window.t_high, [&](double t) {
    const double angle = meter.row(motion, t, {&ring, 1}).angle_rad;
    if (angle > best.angle_rad) best = {angle, t, s};
    return angle;
  });
  return best;
}

EngagementPeak EngagementMeter::look_between(const RuledMotion& motion, const Engagement& measured) {
  constexpr std::size_t kLooks = 2;
  near_.begin(motion);
  std::vector<std::size_t> rows = largest_rows(measured.rows);
  rows.resize(std::min(rows.size(), kLooks));
  reserve(rows.size());
  const double step = 1.0 / (static_cast<double>(measured.rows.size()) - 2.0);
  std::array<EngagementPeak, kLooks> peaks;
  parallel_for(rows.size(), [&](std::size_t k) {
    const double t = measured.rows[rows[k]].t;
    const RidgeWindow window{t - kBeside * step, t + kBeside * step, 0.0, motion.axis_length};
    meters_[k].begin();
    const Ridge ridge = ridge_in(motion, within_motion(window, motion.axis_length), kLeastRings, meters_[k], peaks[k]);
    for (std::size_t ring = 0; ring < ridge.crests.size(); ++ring)
      if (const Crest& crest = ridge.crests[ring]; crest.angle_rad > peaks[k].angle_rad)
        peaks[k] = {crest.angle_rad, crest.t, ridge.s_of(ring)};
  });
  EngagementPeak best = measured.peak;
  for (const EngagementPeak& peak : peaks)
    if (peak.angle_rad > best.angle_rad) best = peak;
  return best;
}

EngagementPeak EngagementMeter::refine(const RuledMotion& motion, const Engagement& measured, int flank_rings) {
  constexpr double kPromise = 0.01;  // radians
  near_.begin(motion);
  const std::vector<std::size_t> rows = largest_rows(measured.rows);
  reserve(rows.size());
  const double step = 1.0 / (static_cast<double>(measured.rows.size()) - 2.0);
  const int rings = std::max(kLeastRings, (flank_rings + 2) / 3);
  std::array<EngagementPeak, kPeaks> peaks;
  std::array<Ridge, kPeaks> ridges;
  parallel_for(rows.size(), [&](std::size_t k) {
    const double t = measured.rows[rows[k]].t;
    const RidgeWindow window{t - kBeside * step, t + kBeside * step, 0.0, motion.axis_length};
    meters_[k].begin();
    ridges[k] = ridge_in(motion, within_motion(window, motion.axis_length), rings, meters_[k], peaks[k]);
  });
  EngagementPeak best = measured.peak;
  const auto keep = [&](const EngagementPeak& peak) {
    if (peak.angle_rad > best.angle_rad) best = peak;
  };
  for (std::size_t k = 0; k < rows.size(); ++k) keep(peaks[k]);
  // Rows have more rings, so around the largest place of them all there may be a crest of its own.
  const EngagementPeak& top = measured.peak;
  const double apart = motion.axis_length / (flank_rings - 1);
  if (top.angle_rad > 0.0)
    keep(climb(motion, {top.t - step, top.t + step, top.s - apart, top.s + apart}, meters_.front()));
  // What lines promise of a crest is not much less than what is there; the highest one is climbed in any case.
  bool first = true;
  for (const Top& crest : highest_of(std::span(ridges).first(rows.size()))) {
    if (first || crest.angle_rad + kPromise > best.angle_rad) keep(climb(motion, crest.window, meters_.front()));
    first = false;
  }
  return best;
}

PassMeasure measure_pass(const std::vector<RuledMotion>& motions, int sweep_intervals, SweptStock& stock) {
  constexpr int kRows = 202;
  EngagementMeter meter(stock);
  const RowRings rings(stock.radial(), kPassRings, kPassVolumeRings);
  PassMeasure out;
  for (const RuledMotion& motion : motions) {
    const Engagement e = meter.measure(motion, rings, kRows);
    out.volume_mm3 += e.volume_mm3;
    out.largest_rad = std::max(out.largest_rad, meter.refine(motion, e, kPassRings).angle_rad);
    stock.add(Sweep::of(motion, sweep_intervals));
  }
  return out;
}

double largest_engagement(const std::vector<Pose>& way, const SweptStock& stock) {
  constexpr int kLeastRows = 5;
  constexpr double kRowsARadius = 8.0;
  const double length = stock.radial().axis_length();
  EngagementMeter meter(stock);
  const RowRings rings(stock.radial(), kPassRings, kPassVolumeRings);
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
