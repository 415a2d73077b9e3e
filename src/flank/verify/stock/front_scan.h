/// The engagement angle of a tool in a tri-dexel stock, by scanning the front of its contact circles (MATH section 10).
#pragma once

#include <vector>

#include "flank/verify/stock/dexel_stock.h"

namespace flank::internal::verify {

/// How the axis moves at a pose: per mm of way, or in any other measure of time.
struct PoseVelocity {
  Vec3 tip = Vec3::Zero(), axis = Vec3::Zero();
  [[nodiscard]] Vec3 at(double s) const { return tip + s * axis; }
};

/// An arc of a front in the material, radians from the direction of motion, towards axis x motion. An end is either the
/// front's own or where the surface of the stock crosses.
struct FrontArc {
  double low = 0.0, high = 0.0;
  bool low_crosses = false, high_crosses = false;
};

/// Measures on circles of some heights. Immutable.
class FrontScan {
 public:
  /// `count` (>= 2) circles at equal steps of s, both ends of the axis among them.
  FrontScan(const RadialFunction& radial, int count);

  struct Largest {
    double angle_rad = 0.0, s = 0.0;
  };
  /// The largest over the circles. The stock is one that the tool at this pose has been cut from, and nothing of what comes
  /// later: the front is looked at just outside of the tool, and its ends are carried back onto it.
  [[nodiscard]] Largest largest(const DexelStock& stock, const Pose& pose, const PoseVelocity& velocity) const;
  /// Of the circle of s, in [0, L], mm.
  [[nodiscard]] double angle(const DexelStock& stock, const Pose& pose, const PoseVelocity& velocity, double s) const;

 private:
  RadialFunction radial_;
  int count_;
};

}  // namespace flank::internal::verify
