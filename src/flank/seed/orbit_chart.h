/// The chart of a target that a motion moves along itself.
#pragma once

#include <vector>

#include "flank/seed/chart.h"
#include "flank/seed/self_motion.h"

namespace flank::internal {

/// A curve that crosses all orbits of a motion on a target at right angles: all that there is to know of such a target, but
/// for its ends.
class OrbitSection {
 public:
  /// `chart` is the target's own: the section begins as its middle line across the motion, every point of which is
  /// moved along its orbit.
  OrbitSection(const Target& target, const Chart& chart, const SelfMotion& motion);

  [[nodiscard]] const SelfMotion& motion() const { return motion_; }
  /// mm, from border to border.
  [[nodiscard]] double width() const { return width_; }
  /// At a length from where it enters the target, mm; a little before and behind it, too.
  [[nodiscard]] ChartPoint at(double length) const;

  /// First and last time at which a moved point of the section is on the target.
  struct Span {
    double first = 0.0, last = 0.0;
  };
  [[nodiscard]] Span span_at(double length) const;
  /// Of all points of the section.
  [[nodiscard]] Span span() const;

  /// When a point passes the section, and where, as its length: warm from the time of a point nearby.
  struct Crossing {
    double time = 0.0, length = 0.0;
  };
  [[nodiscard]] Crossing crossing_of(const Vec3& p, double time) const;
  /// The same of a point anywhere on the target.
  [[nodiscard]] Crossing crossing_of(const Vec3& p) const;

 private:
  void lay_out(const std::vector<ChartPoint>& line);
  [[nodiscard]] Span times_of_ends(const Chart& chart, bool swapped) const;
  void measure(const Target& target);

  SelfMotion motion_;
  std::vector<ChartPoint> points_;
  std::vector<double> lengths_;
  double width_ = 0.0;
  std::vector<Span> spans_;  ///< of equal parts of the width
};

/// Lines of constant b are orbits of the motion, those of constant a the moved section; b goes by its length. Both cover the
/// target, so where it is cut off askew the corners of the chart lie past it.
[[nodiscard]] Chart orbit_chart(const OrbitSection& section);

}  // namespace flank::internal
