#include "flank/seed/line_start.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace flank::internal {
namespace {

/// Mean signed distance of an axis over the footpoints that count; 0 if none does.
double mean_distance(const Target& target, const Pose& pose, double axis_length) {
  constexpr int kPlaces = 24;  // along the axis
  std::vector<Footpoint> feet(kPlaces);
  track_axis(target, pose, axis_length, feet);
  double sum = 0.0, weight = 0.0;
  for (const Footpoint& foot : feet) {
    const double w = footpoint_weight(foot.location);
    sum += w * foot.distance;
    weight += w;
  }
  return weight > 0.0 ? sum / weight : 0.0;
}

/// Where a propagation ended, in words for the message.
const char* reason(PropagationEnd end) {
  switch (end) {
    case PropagationEnd::kNotRun:
      return "not run";
    case PropagationEnd::kBorder:
      return "the border";
    case PropagationEnd::kMovability:
      return "a place where the line no longer fits the face";
    case PropagationEnd::kStep:
      return "a place where the surface gives no direction";
    case PropagationEnd::kTravel:
      return "the longest travel allowed";
  }
  return "";
}

/// Both ends together: a motion that travelled the longest way in both directions has gone round a closed face.
LineStartStatus status_of(const Propagation& backward, const Propagation& forward) {
  if (backward.steps + forward.steps == 0) return LineStartStatus::kNoMotion;
  if (backward.end == PropagationEnd::kBorder && forward.end == PropagationEnd::kBorder)
    return LineStartStatus::kBorderToBorder;
  if (backward.end == PropagationEnd::kTravel && forward.end == PropagationEnd::kTravel)
    return LineStartStatus::kClosed;
  return LineStartStatus::kPartial;
}

std::string message_of(const LineStartReport& report) {
  char text[320];
  std::snprintf(text, sizeof text,
                "the first tool axis was moved %.4g mm along the face in %d steps, from %s to %s; loss of contact "
                "%.2g (0: in contact all along; %.2g before the search, %.2g at worst)",
                report.travel_mm, report.backward_steps + report.forward_steps, reason(report.backward),
                reason(report.forward), report.movability_after, report.movability_before, report.worst_movability);
  return text;
}

/// Cubic Hermite value between samples k and k + 1 with the slopes of the chords beside them (travel is not equally
/// spaced).
Vec3 hermite(const std::vector<Vec3>& p, const std::vector<double>& t, std::size_t k, double at) {
  const auto slope = [&](std::size_t i) {
    const std::size_t low = i > 0 ? i - 1 : 0, high = std::min(i + 1, p.size() - 1);
    return Vec3((p[high] - p[low]) / (t[high] - t[low]));
  };
  const double h = t[k + 1] - t[k], x = (at - t[k]) / h, y = 1.0 - x;
  return y * y * (1.0 + 2.0 * x) * p[k] + x * x * (1.0 + 2.0 * y) * p[k + 1] +
         h * x * y * (y * slope(k) - x * slope(k + 1));
}

/// The two halves as one motion, parameter by travel. Steps differ in length: poses are filled in, so that every
/// control point has data.
RuledMotion join(const Propagation& backward, const Propagation& forward, double axis_length, int count) {
  std::vector<Vec3> tips, axes;
  std::vector<double> travel;
  const auto add = [&](const Pose& pose, double at) {
    tips.push_back(pose.tip);
    axes.push_back(pose.axis);
    travel.push_back(at);
  };
  // Backwards first, from its end; both begin with the line itself, which is taken once.
  for (std::size_t k = backward.poses.size(); k-- > 1;) add(backward.poses[k], -backward.travel_mm[k]);
  for (std::size_t k = 0; k < forward.poses.size(); ++k) add(forward.poses[k], forward.travel_mm[k]);
  std::vector<Pose> dense;
  std::vector<double> times;
  constexpr int kPerControlPoint = 8;  // so that least squares does not see where the samples lie
  const int samples = kPerControlPoint * count;
  std::size_t k = 0;
  for (int i = 0; i <= samples; ++i) {
    times.push_back(static_cast<double>(i) / samples);
    const double at = travel.front() + (travel.back() - travel.front()) * times.back();
    while (k + 2 < travel.size() && travel[k + 1] < at) ++k;
    dense.push_back({hermite(tips, travel, k, at), hermite(axes, travel, k, at).normalized()});
  }
  return fit_motion(dense, times, axis_length, count);
}

}  // namespace

int side_of_line(const Target& target, const Pose& pose, double axis_length) {
  return mean_distance(target, pose, axis_length) < 0.0 ? -1 : 1;
}

LineStart start_from_line(const Target& target, const Pose& start, double axis_length,
                          const LineStartOptions& options) {
  LineStart out;
  LineStartReport& report = out.report;
  const LineSearch search = search_line(target, start, axis_length, options.search);
  report.movability_before = search.before.value;
  report.movability_after = search.after.value;
  report.shift_mm = search.shift_mm;
  report.mean_distance_mm = mean_distance(target, search.pose, axis_length);
  const Vec3 heading = search.after.velocity.middle;
  // The same velocity and its opposite: the line may lie anywhere on the face.
  const Propagation forward = propagate(target, search.pose, axis_length, heading, options.propagation);
  const Propagation backward = propagate(target, search.pose, axis_length, -heading, options.propagation);
  report.forward = forward.end;
  report.backward = backward.end;
  report.forward_steps = forward.steps;
  report.backward_steps = backward.steps;
  report.worst_movability = std::max(forward.worst_movability, backward.worst_movability);
  report.worst_drift_mm = std::max(forward.worst_drift_mm, backward.worst_drift_mm);
  report.travel_mm = forward.travel_mm.back() + backward.travel_mm.back();
  report.status = status_of(backward, forward);
  report.message = message_of(report);
  if (!search.after.valid())
    report.message = "the nearest points of the face all lie on its border; place the line over the face";
  if (report.status != LineStartStatus::kNoMotion)
    out.motion = join(backward, forward, axis_length, options.control_points);
  return out;
}

}  // namespace flank::internal
