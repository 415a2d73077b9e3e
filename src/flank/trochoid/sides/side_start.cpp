#include "flank/trochoid/sides/side_start.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace flank::internal {
namespace {

constexpr int kControlPoints = 12;
constexpr double kOverlap = 0.05;        ///< of a layer's height, shared with its neighbours
constexpr double kBeforeBlocked = 0.08;  ///< of the way that clear_start leaves, which goes a little too far
constexpr double kLonger = 1.02;         ///< the axis past the longest offset contact line (MATH section 7)

struct Laid {
  std::vector<RuledMotion> motions;  ///< a layer each, in the order of the chart's bands
  bool walled = false;               ///< a wall says where the tips are
};

/// Layer k of n on the chart, and what it shares with its neighbours.
RuledStart band_of(const RuledStart& start, int k, int n) {
  RuledStart band = start;
  const double overlap = n > 1 ? 0.5 * kOverlap / n : 0.0;
  band.band_low = std::max(0.0, static_cast<double>(k) / n - overlap);
  band.band_high = std::min(1.0, (k + 1.0) / n + overlap);
  return band;
}

/// Axis turned end for end.
RuledMotion upside_down(const RuledMotion& motion) {
  constexpr int kTimes = 81;
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int i = 0; i < kTimes; ++i) {
    t.push_back(i / (kTimes - 1.0));
    const Pose pose = motion.pose(t.back());
    poses.push_back({pose.at(motion.axis_length), -pose.axis});
  }
  return fit_motion(poses, t, motion.axis_length, motion.tip.count());
}

/// Time run backwards.
RuledMotion backwards(const RuledMotion& motion) {
  constexpr int kTimes = 81;
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int i = 0; i < kTimes; ++i) {
    t.push_back(i / (kTimes - 1.0));
    poses.push_back(motion.pose(1.0 - t.back()));
  }
  return fit_motion(poses, t, motion.axis_length, motion.tip.count());
}

Vec3 travel(const RuledMotion& motion) {
  const double middle = 0.5 * motion.axis_length;
  return motion.pose(1.0).at(middle) - motion.pose(0.0).at(middle);
}

/// How far lines of a band go along the way, and how many of them end at a floor.
struct Upright {
  double first = 0.0, last = 1.0;
  int on_floor = 0;
};

/// A wall across the way that lines lean against leaves ever less of them: followed to the end, the tool would rise along its own
/// axis, a way on which no cycle gets on. So the way ends where half of a line is blocked; nor is such a wall a floor.
/// Likewise where walls leave less than half of a line and are at both of its ends, as in the corner that a side makes with a wall
/// that its lines run along: a ball has no room there but for shreds, and through them the tip would go astray.
Upright upright_part(const ClearStart& clear, const Chart& chart, const RuledStart& band) {
  constexpr double kFree = 0.5, kGrowing = 1e-3;  // of the longest free stretch
  const int n = static_cast<int>(clear.lines.size());
  const auto free = [&](int i) {
    const ClearStart::Line& line = clear.lines[static_cast<std::size_t>(i)];
    return line.free ? (line.high - line.low) / clear.longest_mm : 0.0;
  };
  const auto blocked = [&](int i) {
    const ClearStart::Line& line = clear.lines[static_cast<std::size_t>(i)];
    return !line.free || line.low_blocked || line.high_blocked;
  };
  const auto time = [&](int i) { return clear.first + (clear.last - clear.first) * i / (n - 1.0); };
  Upright out{clear.first, clear.last, 0};
  int from = 0, to = n - 1;
  const auto pass = [&](int& i, int by, double& end) {
    while (i + by >= 0 && i + by < n && blocked(i) && (free(i) < kFree || free(i + by) > free(i) + kGrowing)) {
      if (free(i) < kFree) end = time(i + by);
      i += by;
    }
  };
  const auto hemmed = [&](int i) {
    const ClearStart::Line& line = clear.lines[static_cast<std::size_t>(i)];
    return line.low_blocked && line.high_blocked &&
           !(line.high - line.low >= kFree * axis_line(chart, band, time(i)).length);
  };
  for (; from + 1 < n && hemmed(from); ++from) out.first = time(from + 1);
  for (; to > from && hemmed(to); --to) out.last = time(to - 1);
  if (clear.first > 0.0) pass(from, +1, out.first);
  if (clear.last < 1.0) pass(to, -1, out.last);
  for (int i = from; i <= to; ++i)
    if (clear.lines[static_cast<std::size_t>(i)].free && blocked(i)) ++out.on_floor;
  return out;
}

double longest_line(const CavitySide& side, const Chart& chart, const RuledStart& start, int layers) {
  double longest = 0.0;
  for (int k = 0; k < layers; ++k) {
    const RuledStart band = band_of(start, k, layers);
    double length = kLonger * longest_chord(chart, band);
    if (side.obstacles != nullptr) {
      const ClearStart clear = clear_start(chart, band, *side.obstacles);
      if (clear.free_lines > 0 && upright_part(clear, chart, band).on_floor > kStartTimes / 4)
        length = kLonger * clear.longest_mm;
    }
    longest = std::max(longest, length);
  }
  return longest;
}

Laid lay(const CavitySide& side, const Chart& chart, const RuledStart& start, int layers, double length) {
  Laid out;
  for (int k = 0; k < layers; ++k) {
    RuledStart band = band_of(start, k, layers);
    if (side.obstacles != nullptr) {
      const ClearStart clear = clear_start(chart, band, *side.obstacles);
      if (clear.free_lines == 0) return {};
      // A wall across the way ends it, before the first line that it blocks: a fit that begins in the wall is thrown far off.
      const double inset = kBeforeBlocked * (clear.last - clear.first);
      const Upright upright = upright_part(clear, chart, band);
      if (upright.on_floor > kStartTimes / 4) {
        band.first = upright.first, band.last = upright.last;
        const bool shorter = upright.first > clear.first || upright.last < clear.last;
        out.motions.push_back(
            make_motion(shorter ? clear_start(chart, band, *side.obstacles) : clear, length, kControlPoints));
        out.walled = true;
        continue;
      }
      if (clear.first > 0.0) band.first = std::max(clear.first + inset, upright.first);
      if (clear.last < 1.0) band.last = std::min(clear.last - inset, upright.last);
    }
    out.motions.push_back(make_motion(chart, band, length, kControlPoints));
  }
  return out;
}

/// Layers of one side with tips and travel as wanted.
void turn(Laid& laid, const Vec3& up, const Vec3& along) {
  for (RuledMotion& motion : laid.motions) {
    if (motion.pose(0.5).axis.dot(up) < 0.0) motion = upside_down(motion);
    if (travel(motion).dot(along) < 0.0) motion = backwards(motion);
  }
  std::stable_sort(laid.motions.begin(), laid.motions.end(), [&](const RuledMotion& a, const RuledMotion& b) {
    return a.pose(0.5).tip.dot(up) > b.pose(0.5).tip.dot(up);
  });
}

/// Where the line of a start goes from its first half to its second one.
Vec3 way_of(const Chart& chart, const RuledStart& start) {
  return (axis_line(chart, start, 0.75).middle - axis_line(chart, start, 0.25).middle).normalized();
}

/// The lines of the right chart that go the way of the left ones, and of those the most nearly parallel to them. On blades that are
/// twisted lines across those may be as parallel, and a tool that goes up one side while it goes along the other mills no cavity.
RuledStart like(const Chart& chart, const SideStart& start, const Chart& left_chart, const RuledStart& left) {
  constexpr double kOneWay = 0.2;  // cosines that differ by more are not of one way
  const Vec3 direction = axis_line(left_chart, left, 0.5).direction, way = way_of(left_chart, left);
  std::array<double, 2> along = {};
  std::vector<RuledStart> all;
  for (const bool swapped : {false, true}) {
    for (const double sign : {1.0, -1.0}) {
      RuledStart& tried = all.emplace_back();
      tried.swapped = swapped;
      tried.skew_rad = sign * start.skew_rad;
      tried.radius_mm = start.radius_mm;
      along[swapped] = std::max(along[swapped], std::abs(way_of(chart, tried).dot(way)));
    }
  }
  RuledStart best;
  double most = -1.0;
  for (const RuledStart& tried : all) {
    if (along[tried.swapped] < along[!tried.swapped] - kOneWay) continue;
    const double parallel = std::abs(axis_line(chart, tried, 0.5).direction.dot(direction));
    if (!(parallel > most + 1e-9)) continue;
    most = parallel;
    best = tried;
  }
  return best;
}

/// Up where nothing says so: towards the wider end.
Vec3 towards_wider(const RuledMotion& left, const RuledMotion& right) {
  const Pose a = left.pose(0.5), b = right.pose(0.5);
  const double sign = b.axis.dot(a.axis) < 0.0 ? -1.0 : 1.0;
  const auto width = [&](double s) { return (a.at(s) - b.at(sign > 0.0 ? s : right.axis_length - s)).norm(); };
  return width(left.axis_length) >= width(0.0) ? a.axis : Vec3(-a.axis);
}

/// Both sides, laid.
struct LaidSides {
  Laid left, right;
  double length = 0.0;
  Vec3 above = Vec3::Zero(), along = Vec3::Zero();
};

/// Not turned yet. No motions: no line is free.
LaidSides lay_sides(const CavitySide& left, const CavitySide& right, const Chart& left_chart, const Chart& right_chart,
                    const RuledStart& on_left, const RuledStart& on_right, int layers,
                    const std::function<double(double)>& axis_length, const std::optional<Vec3>& up) {
  LaidSides out;
  out.length = axis_length(
      std::max(longest_line(left, left_chart, on_left, layers), longest_line(right, right_chart, on_right, layers)));
  out.left = lay(left, left_chart, on_left, layers, out.length);
  out.right = lay(right, right_chart, on_right, layers, out.length);
  if (out.left.motions.empty() || out.right.motions.empty()) return {};
  const RuledMotion &a = out.left.motions.front(), &b = out.right.motions.front();
  out.above = up.value_or(towards_wider(a, b));
  if (out.left.walled)
    out.above = a.pose(0.5).axis;
  else if (out.right.walled)
    out.above = b.pose(0.5).axis;
  out.along = travel(a);
  return out;
}

/// The start as a cone of this tip, which is at the lower end of its lines.
RuledStart widening(const Chart& chart, RuledStart start, double tip_mm, double length, const Vec3& above) {
  start.lean_rad = std::asin(std::clamp((start.radius_mm - tip_mm) / length, 0.0, 1.0));
  start.radius_mm = tip_mm;
  start.tip_high = axis_line(chart, start, 0.5).direction.dot(above) < 0.0;
  return start;
}

}  // namespace

std::vector<FitTask> side_tasks(const CavitySide& left, const CavitySide& right, const Chart& left_chart,
                                const Chart& right_chart, const SideStart& start, int layers,
                                const std::function<double(double)>& axis_length, const std::optional<Vec3>& up) {
  RuledStart on_left;
  on_left.swapped = start.swapped;
  on_left.skew_rad = start.skew_rad;
  on_left.radius_mm = start.radius_mm;
  const RuledStart on_right = like(right_chart, start, left_chart, on_left);
  const auto laid_as = [&](const RuledStart& a, const RuledStart& b) {
    return lay_sides(left, right, left_chart, right_chart, a, b, layers, axis_length, up);
  };
  LaidSides laid = laid_as(on_left, on_right);
  // Where the tips are a cylinder shows.
  if (start.tip_mm < start.radius_mm && !laid.left.motions.empty()) {
    const Vec3 above = laid.above;
    laid = laid_as(widening(left_chart, on_left, start.tip_mm, laid.length, above),
                   widening(right_chart, on_right, start.tip_mm, laid.length, above));
    laid.above = above;
  }
  auto &a = laid.left, &b = laid.right;
  if (a.motions.empty()) return {};
  turn(a, laid.above, laid.along);
  turn(b, laid.above, laid.along);
  std::vector<FitTask> tasks;
  for (std::size_t k = 0; k < a.motions.size(); ++k) {
    tasks.push_back({left.target, a.motions[k], left.obstacles});
    tasks.push_back({right.target, b.motions[k], right.obstacles});
  }
  return tasks;
}

}  // namespace flank::internal
