/// A rectangle of points laid over a target, so that starts can speak of "across" and "along" whatever the target is
/// made of.
#pragma once

#include <functional>
#include <vector>

#include "flank/target.h"

namespace flank::internal {

/// A point on (or near) the target, mm, and the unit normal there, towards the machining side.
struct ChartPoint {
  Vec3 point, normal;
};

/// Immutable after construction. Good to a few hundredths of a tool's radius, not to a tolerance: for starts alone.
class Chart {
 public:
  /// One NURBS face: its own parameter directions. Several faces or a mesh: the two long principal directions of its
  /// samples, so a target that bends by more than half a turn folds onto itself.
  explicit Chart(const Target& target);
  /// Of any other rectangle of points: asked once for a grid that reaches a little past [0, 1] x [0, 1].
  explicit Chart(const std::function<ChartPoint(double a, double b)>& point_at);

  /// Point and unit normal at (a, b), [0, 1] x [0, 1] over the target's extent; beyond it the target's extension, then
  /// linear.
  [[nodiscard]] ChartPoint at(double a, double b) const;
  /// Mean length of the lines of constant b and of constant a, mm.
  [[nodiscard]] double length_a() const { return length_a_; }
  [[nodiscard]] double length_b() const { return length_b_; }

 private:
  static constexpr int kNodes = 37;         ///< per side; the outer ones lie past the border
  static constexpr double kOverrun = 0.08;  ///< of the extent, on each side: inside the target's extension (0.10)

  void measure();

  std::vector<ChartPoint> nodes_;  ///< [i * kNodes + j], i along a
  double length_a_ = 0.0, length_b_ = 0.0;
};

}  // namespace flank::internal
