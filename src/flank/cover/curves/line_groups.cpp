#include "flank/cover/curves/line_groups.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "flank/base/parallel.h"
#include "flank/cover/curves/line_clusters.h"

namespace flank::internal {
namespace {

/// A line of a group: `velocity` in the sense of the group's motion.
struct Step {
  int line = -1;
  Pose pose;
  AxisVelocity velocity;
};

class Grouper {
 public:
  Grouper(const std::vector<StraightLine>& lines, double axis_length, const LineGroupOptions& options)
      : lines_(lines), length_(axis_length), options_(options) {
    reach_ = options.reach * median_distance();
  }

  /// Follows the motion from `start` until no line lies that way; `used` are the lines of the group.
  [[nodiscard]] std::vector<Step> follow(const Step& start, std::vector<char>& used) const;
  [[nodiscard]] Step at(std::size_t line) const {
    return {static_cast<int>(line), lines_[line].pose, lines_[line].velocity};
  }

 private:
  [[nodiscard]] Step next(const Step& last, const std::vector<char>& used) const;
  [[nodiscard]] Step facing(std::size_t line, const Step& last) const;
  [[nodiscard]] double distance(std::size_t a, std::size_t b) const;
  [[nodiscard]] double median_distance() const;

  const std::vector<StraightLine>& lines_;
  double length_, reach_ = 0.0;
  const LineGroupOptions& options_;
};

/// mm: root mean square over the axis, the smaller one of both senses if the tool's ends are alike.
double Grouper::distance(std::size_t a, std::size_t b) const {
  double d = squared_line_distance(lines_[a].pose, lines_[b].pose, length_);
  if (options_.ends_alike)
    d = std::min(d, squared_line_distance(lines_[a].pose, turned_round(lines_[b].pose, length_), length_));
  return std::sqrt(d);
}

/// Median, not mean: lines that stand alone must not widen the reach of all others.
double Grouper::median_distance() const {
  std::vector<double> nearest(lines_.size(), 1e300);
  parallel_for(lines_.size(), [&](std::size_t a) {
    for (std::size_t b = 0; b < lines_.size(); ++b)
      if (a != b) nearest[a] = std::min(nearest[a], distance(a, b));
  });
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::nth_element(nearest.begin(), middle, nearest.end());
  return *middle;
}

/// The line turned round, and its velocity reversed, if that fits the last line better. Turning round keeps the
/// velocity of the middle and changes the sign of omega, the derivative of an axis that has changed its own.
Step Grouper::facing(std::size_t line, const Step& last) const {
  Step step = at(line);
  if (options_.ends_alike && step.pose.axis.dot(last.pose.axis) < 0.0) {
    step.pose = turned_round(step.pose, length_);
    step.velocity.omega = -step.velocity.omega;
  }
  if (step.velocity.middle.dot(last.velocity.middle) < 0.0)
    step.velocity = {-step.velocity.middle, -step.velocity.omega};
  return step;
}

/// The line that the motion meets next; line -1: none lies that way. Its distance is measured across the axis, since a
/// slide along it is no travel.
Step Grouper::next(const Step& last, const std::vector<char>& used) const {
  const Vec3 middle = last.pose.at(0.5 * length_);
  const Vec3 heading = (last.velocity.middle - last.velocity.middle.dot(last.pose.axis) * last.pose.axis).normalized();
  Step best;
  double least = 1e300;
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    if (used[k] != 0) continue;
    const double way = (lines_[k].pose.at(0.5 * length_) - middle).dot(heading);
    if (way <= 0.0 || way > reach_) continue;
    const Step step = facing(k, last);
    const Vec3 axis = (last.pose.axis + way * last.velocity.omega).normalized();
    const Pose predicted{middle + way * last.velocity.middle - 0.5 * length_ * axis, axis};
    const double deviation = squared_line_distance(predicted, step.pose, length_);
    // The farther the line, the more it may be off: the motion is known to first order only.
    if (deviation > std::pow(options_.most_deviation * way, 2)) continue;
    // Near ones first: a line that is skipped is lost to the group.
    const double cost = way * way + options_.deviation_weight * deviation;
    if (cost >= least) continue;
    least = cost;
    best = step;
  }
  return best;
}

std::vector<Step> Grouper::follow(const Step& start, std::vector<char>& used) const {
  std::vector<Step> steps;
  for (Step step = next(start, used); step.line >= 0; step = next(step, used)) {
    used[static_cast<std::size_t>(step.line)] = 1;
    steps.push_back(step);
  }
  return steps;
}

/// Both ways from one line, without meeting any line twice: `used` is shared by both.
LineGroup group_from(const Grouper& grouper, std::size_t line, std::size_t lines) {
  std::vector<char> used(lines, 0);
  used[line] = 1;
  Step start = grouper.at(line);
  const std::vector<Step> after = grouper.follow(start, used);
  start.velocity = {-start.velocity.middle, -start.velocity.omega};
  std::vector<Step> steps = grouper.follow(start, used);
  std::reverse(steps.begin(), steps.end());
  steps.push_back(start);
  steps.insert(steps.end(), after.begin(), after.end());
  LineGroup group;
  for (const Step& step : steps) {
    group.lines.push_back(step.line);
    group.poses.push_back(step.pose);
  }
  return group;
}

}  // namespace

std::vector<LineGroup> group_lines(const std::vector<StraightLine>& lines, double axis_length,
                                   const LineGroupOptions& options) {
  std::vector<LineGroup> groups;
  if (lines.size() < 2) return groups;
  const Grouper grouper(lines, axis_length, options);
  std::vector<std::size_t> order(lines.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return lines[a].error_mm < lines[b].error_mm; });
  std::vector<int> uses(lines.size(), 0);
  for (const std::size_t k : order) {
    // What is in enough groups need not begin one of its own.
    if (uses[k] >= options.most_uses) continue;
    LineGroup group = group_from(grouper, k, lines.size());
    for (const int line : group.lines) ++uses[static_cast<std::size_t>(line)];
    if (static_cast<int>(group.lines.size()) >= options.least_lines) groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace flank::internal
