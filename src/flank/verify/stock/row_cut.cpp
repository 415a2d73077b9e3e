#include "flank/verify/stock/row_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "flank/base/parallel.h"

namespace flank::internal::verify {
namespace {

/// Lines that are looked at in one go.
constexpr int kLines = 64;
using Touched = std::array<double, kLines>;

/// The lines of a row as the tool sees them: what ToolLine has is a polynomial of the place across.
struct RowLines {
  ToolLine base;
  double per_z = 0.0, per_b = 0.0, per_c = 0.0, per_c2 = 0.0;
  /// `by`: mm across from the base.
  [[nodiscard]] ToolLine at(double by) const {
    return {base.z0 + by * per_z, base.dz, base.a, base.b + by * per_b, base.c + by * (per_c + by * per_c2)};
  }
};

RowLines lines_of(const DexelField& field, const Pose& pose, const Vec3& x) {
  const Vec3 direction = Vec3::Unit(field.axis()), over = Vec3::Unit(field.across());
  RowLines out;
  out.base = ToolSolid::line(pose, x, direction);
  out.per_z = over.dot(pose.axis);
  const Vec3 p = x - pose.tip, p_across = p - out.base.z0 * pose.axis, over_across = over - out.per_z * pose.axis;
  out.per_b = over_across.dot(direction - out.base.dz * pose.axis);
  out.per_c = 2.0 * over_across.dot(p_across);
  out.per_c2 = over_across.squaredNorm();
  return out;
}

/// Heights of the axis, and the largest radius there is of the tool, where a plane across an axis of the frame meets it.
struct RowReach {
  double from = 0.0, to = 0.0, radius = 0.0;
};

RowReach reach_of(const ToolSolid& tool, const Pose& pose, int c, double place) {
  RowReach out{tool.low(), tool.high(), tool.largest()};
  const double along = pose.axis[c];
  if (std::abs(along) < 1e-12) return out;
  // A point of the tool at height z lies within radius * sine of the axis' own place there.
  const double sine = std::sqrt(std::max(0.0, 1.0 - along * along));
  const double p = (place - pose.tip[c]) / along, off = tool.largest() * sine / std::abs(along);
  out.from = std::max(tool.low(), p - off);
  out.to = std::min(tool.high(), p + off);
  out.radius = tool.largest(out.from, out.to);
  return out;
}

/// What the tool may touch of a row: within a cylinder about its axis, and between two places along the lines.
struct RowLook {
  RowLines lines;
  double excess = 0.0;  ///< squared radius of the cylinder, and a little more
  double low = 0.0, high = 0.0;
  double first = 0.0, cell = 0.0;  ///< where the first of the lines lies across from the base, and the next ones, mm
};

/// Where the material of lines begins and ends, and where their gaps do (dexel_field.h).
struct LineEnds {
  const float *lows, *highs, *gap_lows, *gap_highs;
};

/// > 0: stretches from `lows` to `highs` may be touched. Of others the nearest place of the line to the axis lies beyond one of their ends, which is
/// outside of the cylinder (ToolSolid::passes_by).
FLANK_LANES void look_at_stretches(std::size_t count, const RowLook& row, const float* __restrict lows,
                                   const float* __restrict highs, double* __restrict touched) {
  const double a = row.lines.base.a, base_b = row.lines.base.b, base_c = row.lines.base.c - row.excess,
               per_b = row.lines.per_b, per_c = row.lines.per_c, per_c2 = row.lines.per_c2, first = row.first,
               cell = row.cell, from = row.low, to = row.high;
  for (std::size_t k = 0; k < count; ++k) {
    const double low = lows[k], high = highs[k], by = first + static_cast<double>(static_cast<std::int32_t>(k)) * cell;
    const double b = base_b + by * per_b, c = base_c + by * (per_c + by * per_c2);
    // Both > 0: the line leaves the axis behind at this end, and is outside of the cylinder there.
    const double leaves_high = -(a * high + b), out_high = (a * high + 2.0 * b) * high + c;
    const double leaves_low = a * low + b, out_low = (a * low + 2.0 * b) * low + c;
    const double beyond = leaves_high < out_high ? leaves_high : out_high;
    const double before = leaves_low < out_low ? leaves_low : out_low;
    const double beside = beyond > before ? beyond : before;
    const double met = to - low < high - from ? to - low : high - from;
    touched[k] = beside > 0.0 ? -1.0 : met;
  }
}

/// Most are not: several are passed over at once.
template <class Use>
void for_each_touched(Touched& touched, std::size_t count, const Use& use) {
  constexpr std::size_t kTogether = 8;
  const std::size_t end = (count + kTogether - 1) / kTogether * kTogether;
  std::fill(touched.begin() + static_cast<std::ptrdiff_t>(count), touched.begin() + static_cast<std::ptrdiff_t>(end),
            -1.0);
  for (std::size_t first = 0; first < end; first += kTogether) {
    double most = touched[first];
    for (std::size_t k = first + 1; k < first + kTogether; ++k) most = most < touched[k] ? touched[k] : most;
    for (std::size_t k = first; most > 0.0 && k < first + kTogether; ++k)
      if (touched[k] > 0.0) use(k);
  }
}

class RowCutter {
 public:
  RowCutter(DexelField& field, const LineWeights& weights, const ToolSolid& tool, int row)
      : field_(field), weights_(weights), tool_(tool), row_(row) {}
  double cut(const Pose& pose);

 private:
  [[nodiscard]] double cut_line(int line, const ToolLine& seen, const RowLook& look, double radius);
  /// Whether the tool surely takes nothing of a line: what is left of most begins where it has just been.
  [[nodiscard]] bool is_beside(int line, const ToolLine& seen, const RowLook& look) const;
  DexelField& field_;
  const LineWeights& weights_;
  const ToolSolid& tool_;
  int row_;
};

bool RowCutter::is_beside(int line, const ToolLine& seen, const RowLook& look) const {
  bool beside = true;
  field_.visit(row_, line, [&](const DexelSpan& span) {
    const double low = std::max<double>(span.low, look.low), high = std::min<double>(span.high, look.high);
    beside = beside && (low >= high || tool_.misses(seen, low, high));
  });
  return beside;
}

double RowCutter::cut_line(int line, const ToolLine& seen, const RowLook& look, double radius) {
  if (is_beside(line, seen, look)) return 0.0;
  LineCut within;
  if (!tool_.reach(seen, radius, within) || !field_.meets(row_, line, within.low, within.high)) return 0.0;
  const LineCuts cuts = tool_.cut(seen, within);
  double length = 0.0;
  for (int n = 0; n < cuts.count; ++n) {
    const LineCut& stretch = cuts.cuts[static_cast<std::size_t>(n)];
    length += field_.subtract(row_, line, stretch.low, stretch.high);
  }
  return length > 0.0 ? length * weights_.between(field_, row_, line, within.low, within.high) : 0.0;
}

double RowCutter::cut(const Pose& pose) {
  const int b = field_.across(), c = field_.up();
  Vec3 x = Vec3::Zero();
  x[c] = field_.place_up(row_);
  const RowReach reach = reach_of(tool_, pose, c, x[c]);
  if (reach.from > reach.to) return 0.0;
  const double u = pose.at(reach.from)[b], v = pose.at(reach.to)[b];
  const int left = std::max(0, clipped(std::ceil(field_.line_at(std::min(u, v) - reach.radius)), field_.width()));
  const int right =
      std::min(field_.width() - 1, clipped(std::floor(field_.line_at(std::max(u, v) + reach.radius)), field_.width()));
  x[b] = u;  // near the tool, so that the polynomials are exact to round-off there
  // Of the axis within reach, and as far beside it: beyond, the row's lines are not touched.
  const double p = pose.at(reach.from)[field_.axis()], q = pose.at(reach.to)[field_.axis()];
  RowLook look{lines_of(field_, pose, x),
               reach.radius * reach.radius + ToolSolid::kClear,
               std::min(p, q) - reach.radius,
               std::max(p, q) + reach.radius,
               0.0,
               field_.cell()};
  double removed = 0.0;
  Touched touched, behind;  // not set
  const bool gaps = field_.has_gaps(row_);
  for (int first = left; first <= right; first += kLines) {
    const auto count = static_cast<std::size_t>(std::min(kLines, right + 1 - first));
    look.first = field_.place_across(first) - u;
    look_at_stretches(count, look, field_.lows(row_) + first, field_.gap_lows(row_) + first, touched.data());
    if (gaps) {
      look_at_stretches(count, look, field_.gap_highs(row_) + first, field_.highs(row_) + first, behind.data());
      for (std::size_t k = 0; k < count; ++k) touched[k] = touched[k] < behind[k] ? behind[k] : touched[k];
    }
    for_each_touched(touched, count, [&](std::size_t k) {
      const int line = first + static_cast<int>(k);
      removed += cut_line(line, look.lines.at(field_.place_across(line) - u), look, reach.radius);
    });
  }
  return removed;
}

}  // namespace

int clipped(double x, int count) { return static_cast<int>(std::clamp(x, -1.0, static_cast<double>(count))); }

double cut_row(DexelField& field, const LineWeights& weights, const ToolSolid& tool, const Pose& pose, int row) {
  return RowCutter(field, weights, tool, row).cut(pose);
}

}  // namespace flank::internal::verify
