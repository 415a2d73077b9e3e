#include "flank/fit/starts/start_tasks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "flank/fit/starts/upper_end.h"
#include "flank/seed/clear_start.h"

namespace flank::internal {
namespace {

/// Control points of a start's rails. The quick fit brings them to its own 8 at once; these only carry the start there.
constexpr int kStartControlPoints = 12;

/// Radii to try, equally spaced in logarithm in the middles of kRadii parts of the range: what differs between a thin
/// tool and a thick one is the ratio.
std::vector<double> start_radii(const ToolModel& tool, const RadiusBounds& bounds, double length) {
  if (tool.radius) return {*tool.radius};
  constexpr int kRadii = 5;             // MATH section 7
  constexpr double kLeastRatio = 1e-3;  // of the largest: a lower bound of zero has no logarithm
  std::vector<double> radii;
  // A cylinder that is too slender is no start for a tool that may not be.
  constexpr double kMostRatio = 0.8;
  const double stiff = std::min(0.5 * length / bounds.slenderest, kMostRatio * bounds.largest);
  const double low = std::max({bounds.smallest, kLeastRatio * bounds.largest, tool.free() ? stiff : 0.0});
  for (int k = 0; k < kRadii; ++k) radii.push_back(low * std::pow(bounds.largest / low, (k + 0.5) / kRadii));
  return radii;
}

/// The start cut into bands of equal width side by side, one per strip.
std::vector<RuledStart> bands_of(const RuledStart& start, int strips) {
  std::vector<RuledStart> bands(static_cast<std::size_t>(strips), start);
  for (int k = 0; k < strips; ++k) {
    bands[static_cast<std::size_t>(k)].band_low = static_cast<double>(k) / strips;
    bands[static_cast<std::size_t>(k)].band_high = static_cast<double>(k + 1) / strips;
  }
  return bands;
}

/// The motions of a start beside walls: the tips on the spine of the ball that rolls along target and wall. None if no
/// wall is in the way of the lines.
std::vector<FitTask> make_clear_tasks(const Target& target, const Chart& chart, const RuledStart& start,
                                      const ToolModel& tool, const FlankFitOptions& options) {
  const ObstacleField& obstacles = *options.obstacles;
  constexpr int kFewBlocked = kStartTimes / 4;  // if a wall only grazes the lines, the fit does better than a cut
  constexpr double kLonger = 1.03;              // the axis past the longest stretch from spine to rim (MATH section 7)
  std::vector<ClearStart> bands;
  double length = 0.0;
  bool blocked = false;
  for (const RuledStart& band : bands_of(start, options.strips)) {
    ClearStart clear = clear_start(chart, band, obstacles);
    length = std::max(length, kLonger * clear.longest_mm);
    const bool cut = clear.first > 0.0 || clear.last < 1.0;
    blocked = blocked || cut || clear.blocked_lines > kFewBlocked || clear.free_lines < kStartTimes - kFewBlocked;
    if (clear.free_lines > 0) bands.push_back(std::move(clear));
  }
  if (!blocked) return {};
  length = tool.length_for(length, options.axis_length_mm);
  std::vector<FitTask> tasks;
  for (const ClearStart& band : bands)
    tasks.push_back({&target, make_motion(band, length, kStartControlPoints), &obstacles});
  return tasks;
}

/// The motions of a start, whatever is in their way.
std::vector<FitTask> make_free_tasks(const Target& target, const Chart& chart, const RuledStart& start,
                                     const ToolModel& tool, const FlankFitOptions& options) {
  const std::vector<RuledStart> bands = bands_of(start, options.strips);
  constexpr double kLonger = 1.02;  // the axis past the longest offset contact line (MATH section 7)
  double length = 0.0;
  for (const RuledStart& band : bands) length = std::max(length, kLonger * longest_chord(chart, band));
  length = tool.length_for(length, options.axis_length_mm);
  std::vector<FitTask> tasks;
  for (const RuledStart& band : bands)
    tasks.push_back({&target, make_motion(chart, band, length, kStartControlPoints), options.obstacles});
  return tasks;
}

/// Of the axis from the surface, where it cannot lie along it.
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::array kLeans = {15.0 * kDegree, 30.0 * kDegree, 45.0 * kDegree};

/// The start as a cone of about the same radii over `length` of contact; none where the bounds leave no such cone.
std::optional<RuledStart> leaned(const RuledStart& start, double lean, bool tip_high, double length,
                                 const RadiusBounds& bounds) {
  constexpr double kThinnest = 0.3;  // of the radius of the cylinder: the tip
  const double grows = length * std::tan(lean);
  const double tip = std::max({bounds.smallest, kThinnest * start.radius_mm, start.radius_mm - 0.5 * grows});
  if (tip + grows > bounds.largest || std::sin(lean) > bounds.steepest) return std::nullopt;
  RuledStart leaning = start;
  leaning.radius_mm = tip;
  leaning.lean_rad = lean;
  leaning.tip_high = tip_high;
  return leaning;
}

LaidStart laid(const Target& target, const Chart& chart, const RuledStart& start, const ToolModel& tool,
               const FlankFitOptions& options) {
  LaidStart laid{start, {}};
  if (options.obstacles != nullptr) laid.tasks = make_clear_tasks(target, chart, start, tool, options);
  if (laid.tasks.empty()) laid.tasks = make_free_tasks(target, chart, start, tool, options);
  return laid;
}

/// The largest share of all motions at which nothing could hold the tool.
double unheld_of(const LaidStart& laid, const FlankFitOptions& options) {
  double largest = 0.0;
  for (const FitTask& task : laid.tasks) largest = std::max(largest, unheld_share(task.motion, options));
  return largest;
}

}  // namespace

std::vector<RuledStart> enumerate_starts(const Chart& chart, const ToolModel& tool, const FlankFitOptions& options,
                                         std::initializer_list<bool> ways) {
  // Degrees between contact lines and the chart's lines. Five (MATH section 7), of either sign, because nothing tells
  // which way a blade twists. No start is farther than 6.5 degrees from a direction up to 31 degrees; the fit turns the
  // rest.
  constexpr std::array<double, 5> kSkews = {0.0, 12.0, -12.0, 25.0, -25.0};
  std::vector<RuledStart> starts;
  for (bool swapped : ways) {
    RuledStart across;
    across.swapped = swapped;
    const double length = options.axis_length_mm.value_or(longest_chord(chart, across));
    for (double radius : start_radii(tool, options.bounds, length))
      for (double skew : kSkews) {
        RuledStart start;
        start.swapped = swapped;
        start.radius_mm = radius;
        start.skew_rad = skew * kDegree;
        starts.push_back(start);
      }
  }
  return starts;
}

LaidStart lay_start(const Target& target, const Chart& chart, const RuledStart& start, const ToolModel& tool,
                    const FlankFitOptions& options) {
  const double length = longest_chord(chart, start);
  LaidStart best = laid(target, chart, start, tool, options);
  hold_from_free_end(options, best.tasks);
  double unheld = unheld_of(best, options);
  if (!tool.free() || start.radius_mm <= 0.0) return best;
  for (const double lean : kLeans)
    for (const bool tip_high : {false, true}) {
      if (unheld <= 0.0) return best;
      const std::optional<RuledStart> leaning = leaned(start, lean, tip_high, length, options.bounds);
      if (!leaning) continue;
      LaidStart tried = laid(target, chart, *leaning, tool, options);
      const double share = unheld_of(tried, options);
      if (tried.tasks.empty() || share >= unheld) continue;
      best = std::move(tried);
      unheld = share;
    }
  return best;
}

}  // namespace flank::internal
