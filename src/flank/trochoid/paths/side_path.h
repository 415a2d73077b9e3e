/// A side path as the cycles see it: by the way of the axis' middle, and straight on past both its ends.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "flank/trochoid/paths/half_path.h"

namespace flank::internal {

class SidePath {
 public:
  /// `backwards`: run through from its end to its start.
  SidePath(RuledMotion motion, bool backwards);

  /// Way of the axis' middle, mm.
  [[nodiscard]] double length() const { return way_.back(); }
  [[nodiscard]] double axis_length() const { return motion_.axis_length; }
  /// Place and velocity at x mm from the start; beyond [0, length()] the axis is shifted on, unless it stops there.
  [[nodiscard]] AxisPlace at(double x) const;
  [[nodiscard]] const RuledMotion& motion() const { return motion_; }
  /// The motion from x = from to x = to, over [0, 1]; what is beyond an end is left out. from < to, and some of it inside.
  [[nodiscard]] RuledMotion motion_between(double from, double to) const;
  /// All of the way from x = from to x = to, in its order: what is beyond an end is a motion of its own, close to the places that
  /// at() has there.
  [[nodiscard]] std::vector<RuledMotion> motions_between(double from, double to) const;
  /// Beyond an end the axis is shifted on, along its middle's last direction; this bends the way towards another direction,
  /// a unit vector along x, evenly over a length. Over no less than the tool's radius: then the tool, which rounds the edge
  /// of the side, keeps clear of it for directions up to 45 degrees off.
  void bend_run_out(bool at_end, const Vec3& direction, double over_mm);
  /// Besides, the axis rises beyond an end: by the vector `rise` a millimetre of way, evenly more over a length to begin with,
  /// and from `until_mm` on evenly less over the same length, to none.
  void raise_run_out(bool at_end, const Vec3& rise, double over_mm, double until_mm);
  /// Beyond an end the axis turns about its middle towards a unit vector less than 180 degrees from it, smoothly over a length.
  void turn_run_out(bool at_end, const std::optional<Vec3>& axis, double over_mm);
  /// So far beyond its end, or before its start, there is a wall: from there on the axis stays where it is.
  void stop_at(bool end, double beyond_mm = 0.0) { (end ? beyond_end_ : beyond_start_) = beyond_mm; }
  [[nodiscard]] bool stops_at_end() const { return std::isfinite(beyond_end_); }
  [[nodiscard]] bool stops_at_start() const { return std::isfinite(beyond_start_); }
  /// Where it stops, mm; infinitely far where it does not.
  [[nodiscard]] double first() const { return -beyond_start_; }
  [[nodiscard]] double last() const { return length() + beyond_end_; }
  /// Poses from x = from to x = to: those of the motion within the chord tolerance, and the ends beyond it.
  [[nodiscard]] std::vector<Pose> poses(double from, double to, double chord_mm) const;

 private:
  [[nodiscard]] AxisPlace inside(double t) const;
  /// What is beyond one end, from < to.
  [[nodiscard]] RuledMotion run_out_between(double from, double to) const;
  /// The time of x in [0, length()].
  [[nodiscard]] double time_of(double x) const;
  RuledMotion motion_;  ///< in the direction of the cycles
  struct RunOut {
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();  ///< directions at the end of the side, and `over` beyond it
    Vec3 rise = Vec3::Zero();
    double over_mm = 1.0, rise_over_mm = 1.0;
    double rise_until_mm = std::numeric_limits<double>::infinity();
    std::optional<Vec3> axis;  ///< none: it does not turn
    double turn_over_mm = 1.0;
  };
  /// Way along a run-out between two poses that keeps it within a chord tolerance; infinite if it is straight.
  [[nodiscard]] double step_of(const RunOut& out, double chord_mm) const;
  /// Turns the axis of a place `by` mm beyond an end about its middle.
  void turn_axis(const RunOut& out, double by, double sign, AxisPlace& place) const;
  RunOut before_, after_;
  double beyond_start_ = std::numeric_limits<double>::infinity();
  double beyond_end_ = std::numeric_limits<double>::infinity();
  std::vector<double> way_;  ///< at equal steps of t
};

/// Both side paths of a layer in the direction of the feed. Fronts go from `from` to `to`.
struct LayerSides {
  SidePath from, to;
};

}  // namespace flank::internal
