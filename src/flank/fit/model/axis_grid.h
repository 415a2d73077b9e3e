/// Where a fit looks at its motions: times, places along the axis, and what the axis has there.
#pragma once

#include <array>
#include <vector>

#include "flank/fit/solver/arrow_system.h"
#include "flank/ruled_motion.h"

namespace flank::internal {

/// The same times and places for every motion of a pass, ends included. Immutable after construction.
class AxisGrid {
 public:
  struct Time {
    double t;   ///< in [0, 1]
    int first;  ///< of the four control points that act
    /// Values of the four active basis functions, their derivatives, and their second derivatives times the squared step
    /// in time.
    std::array<double, 4> basis, basis_d1, basis_d2;
  };
  /// A pose with the direction rail's own value w, u = w / |w|.
  struct Pose {
    Vec3 tip, w, u;
    double length_w;
  };

  /// The rails of all motions are like those of `motion`: clamped cubic over [0, 1] with its knots, of its axis length. Both
  /// counts are >= 2.
  AxisGrid(const RuledMotion& motion, int samples_t, int samples_s);

  [[nodiscard]] const std::vector<Time>& times() const { return times_; }
  /// Places along the axis, mm, ascending.
  [[nodiscard]] const std::vector<double>& s() const { return s_; }
  [[nodiscard]] double axis_length() const { return axis_length_; }

  /// The axis of a motion at time i.
  [[nodiscard]] Pose pose(const RuledMotion& motion, std::size_t i) const;
  /// Derivative of a quantity by tip and by axis_length times w, from its gradient by the axis' point at s.
  [[nodiscard]] Vec6 row(const Pose& pose, double s, const Vec3& gradient) const;

 private:
  double axis_length_;
  std::vector<Time> times_;
  std::vector<double> s_;
};

}  // namespace flank::internal
