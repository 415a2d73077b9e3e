#include "flank/seed/clear_start.h"

#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

constexpr int kSteps = 48;  ///< along a line at most; a free stretch shorter than one step is none
constexpr int kRefits = 2;  ///< of a line to its free stretch: each moves the line, and so the wall's place on it
constexpr double kOverrun = 0.03;  ///< a free end is passed by this share of the axis length at most (1.03 stretches)

using Line = ClearStart::Line;

/// Distance of the ball on a line to the walls. A ball on the border of the target touches what begins there, and the chart is
/// good to a few hundredths of a radius: as good as free.
double gap_at(const FittedLine& axis, double sigma, const RuledStart& start, const ObstacleField& obstacles) {
  constexpr double kGood = 0.995;  // radii: see above
  const double radius = radius_at(start, 0.5 * axis.length + (start.tip_high ? -sigma : sigma));
  return obstacles.beside(axis.middle + sigma * axis.direction, kGood * radius) - kGood * radius;
}

/// Where between a free and a blocked place the ball touches.
double touch(const FittedLine& axis, double free, double blocked, const RuledStart& start,
             const ObstacleField& obstacles) {
  constexpr int kHalvings = 12;  // of one step of 48: 5e-6 of the line
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (free + blocked);
    (gap_at(axis, middle, start, obstacles) >= 0.0 ? free : blocked) = middle;
  }
  return free;
}

/// The longest free stretch of the line over its own length.
Line free_stretch(const FittedLine& axis, const RuledStart& start, const ObstacleField& obstacles) {
  Line line{axis};
  const double step = axis.length / kSteps, end = 0.5 * axis.length;
  // `begin`: of the present stretch; `seen`: the last free place of it; `wall`: the last blocked place.
  double begin = end, seen = end, wall = -2.0 * end;
  bool inside = false, blocked_before = false;
  const auto close = [&](double blocked, bool by_wall) {
    const double high = by_wall ? touch(axis, seen, blocked, start, obstacles) : end;
    if (high - begin > line.high - line.low) {
      line.low = begin;
      line.high = high;
      line.low_blocked = blocked_before;
      line.high_blocked = by_wall;
      line.free = true;
    }
    inside = false;
  };
  for (double sigma = -end;;) {
    const double gap = gap_at(axis, sigma, start, obstacles);
    if (gap >= 0.0) {
      if (!inside) {
        blocked_before = wall >= -end;
        begin = blocked_before ? touch(axis, sigma, wall, start, obstacles) : -end;
        inside = true;
      }
      seen = sigma;
    } else {
      if (inside) close(sigma, true);
      wall = sigma;
    }
    if (sigma >= end) break;
    // A distance is 1-Lipschitz: for |gap| along the line of a cylinder nothing changes, neither free nor blocked.
    sigma = std::min(end, sigma + std::max(step, std::abs(gap) / (1.0 + std::sin(start.lean_rad))));
  }
  if (inside) close(end, false);
  line.free = line.free && line.high - line.low > step;
  return line;
}

/// The line of time t, fitted again to what is free of its contact line.
Line clear_line(const Chart& chart, const RuledStart& start, double t, const ObstacleField& obstacles) {
  RuledStart band = start;
  Line line = free_stretch(axis_line(chart, band, t), start, obstacles);
  for (int k = 0; k < kRefits && line.free && (line.low_blocked || line.high_blocked); ++k) {
    const double width = band.band_high - band.band_low;
    const double low = band.band_low + width * (line.low / line.axis.length + 0.5);
    const double high = band.band_low + width * (line.high / line.axis.length + 0.5);
    // A little of what is blocked stays in, so that the next search finds the wall again.
    constexpr double kKept = 0.04;  // of the target's width
    if (line.low_blocked) band.band_low = std::max(start.band_low, low - kKept);
    if (line.high_blocked) band.band_high = std::min(start.band_high, high + kKept);
    const Line next = free_stretch(axis_line(chart, band, t), start, obstacles);
    if (!next.free) break;
    line = next;
  }
  return line;
}

/// Lines without a free stretch move along with their nearest neighbour.
void fill(std::vector<Line>& lines) {
  const int n = static_cast<int>(lines.size());
  std::vector<Line> filled = lines;
  for (int i = 0; i < n; ++i) {
    for (int d = 1; d < n && !filled[i].free; ++d) {
      for (int k : {i - d, i + d}) {
        if (k < 0 || k >= n || !lines[k].free || filled[i].free) continue;
        filled[i] = lines[k];
        filled[i].axis.middle += lines[i].axis.middle - lines[k].axis.middle;
      }
    }
  }
  lines = std::move(filled);
}

/// Lines at kStartTimes times in [first, last].
std::vector<Line> lines_between(const Chart& chart, const RuledStart& start, const ObstacleField& obstacles,
                                double first, double last) {
  std::vector<Line> lines;
  for (int i = 0; i < kStartTimes; ++i)
    lines.push_back(clear_line(chart, start, first + (last - first) * i / (kStartTimes - 1.0), obstacles));
  return lines;
}

/// Of the lines' middles, mm.
double way_of(const std::vector<Line>& lines) {
  double way = 0.0;
  for (std::size_t i = 1; i < lines.size(); ++i) way += (lines[i].axis.middle - lines[i - 1].axis.middle).norm();
  return way;
}

/// The time nearest to that of a line without a free stretch at which there is one, from a time where there is.
double first_free(const Chart& chart, const RuledStart& start, const ObstacleField& obstacles, double blocked,
                  double free) {
  constexpr int kHalvings = 5;  // of a step of 40: a thousandth of the way, less than the radius of any tool
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (free + blocked);
    (clear_line(chart, start, middle, obstacles).free ? free : blocked) = middle;
  }
  return free;
}

}  // namespace

ClearStart clear_start(const Chart& chart, const RuledStart& start, const ObstacleField& obstacles) {
  ClearStart clear;
  if (start.lean_rad != 0.0) clear.tip_high = start.tip_high;
  clear.first = start.first;
  clear.last = start.last;
  clear.lines = lines_between(chart, start, obstacles, clear.first, clear.last);
  const auto is_free = [](const Line& line) { return line.free; };
  const auto first = std::find_if(clear.lines.begin(), clear.lines.end(), is_free);
  if (first == clear.lines.end()) return clear;
  const auto last = std::find_if(clear.lines.rbegin(), clear.lines.rend(), is_free);
  const double step = (start.last - start.first) / (kStartTimes - 1);
  const double begin = start.first + step * static_cast<double>(first - clear.lines.begin());
  const double end = start.last - step * static_cast<double>(last - clear.lines.rbegin());
  // The fit draws the ends of a motion out of a wall by about as much as the tool is thick, and leads it farther along the
  // wall than a cut would.
  constexpr double kPast = 0.5;  // of the ball's radius, past the first and the last line that is free
  const double past = kPast * start.radius_mm / way_of(clear.lines);
  if (begin > start.first)
    clear.first = std::max(start.first, first_free(chart, start, obstacles, begin - step, begin) - past);
  if (end < start.last) clear.last = std::min(start.last, first_free(chart, start, obstacles, end + step, end) + past);
  if (clear.first > start.first || clear.last < start.last)
    clear.lines = lines_between(chart, start, obstacles, clear.first, clear.last);
  for (const Line& line : clear.lines) {
    if (!line.free) continue;
    clear.longest_mm = std::max(clear.longest_mm, line.high - line.low);
    ++clear.free_lines;
    if (line.low_blocked || line.high_blocked) ++clear.blocked_lines;
  }
  fill(clear.lines);
  return clear;
}

RuledMotion make_motion(const ClearStart& start, double axis_length, int count) {
  FLANK_ASSERT(axis_length > 0.0 && count >= 4);
  FLANK_ASSERT(start.lines.size() == static_cast<std::size_t>(kStartTimes));
  int low = 0, high = 0;
  for (const Line& line : start.lines) {
    low += line.low_blocked ? 1 : 0;
    high += line.high_blocked ? 1 : 0;
  }
  // The tip goes to the wall, the holder to the open side, where a lean does not say which end is the tip.
  const bool reversed = start.tip_high.value_or(high > low);
  std::vector<Pose> poses;
  std::vector<double> times;
  for (std::size_t i = 0; i < start.lines.size(); ++i) {
    const Line& line = start.lines[i];
    const Vec3 u = reversed ? Vec3(-line.axis.direction) : line.axis.direction;
    const double from = reversed ? -line.high : line.low, to = reversed ? -line.low : line.high;
    const bool wall = reversed ? line.high_blocked : line.low_blocked;
    double tip = 0.5 * (from + to - axis_length);
    if (wall)
      tip = from;
    else if (low + high > 0)
      tip = from - std::min(kOverrun * axis_length, std::max(0.0, axis_length - (to - from)));
    poses.push_back({line.axis.middle + tip * u, u});
    times.push_back(static_cast<double>(i) / static_cast<double>(start.lines.size() - 1));
  }
  return fit_motion(poses, times, axis_length, count);
}

}  // namespace flank::internal
