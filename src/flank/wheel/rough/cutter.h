/// A tool as roughing asks it: how far a place is from it, and the circles of its flank.
#pragma once

#include <vector>

#include "flank/radial_function.h"
#include "flank/vec.h"

namespace flank::internal {

/// The spheres along the axis, at equal steps of s. Immutable.
class Cutter {
 public:
  explicit Cutter(const RadialFunction& radial);
  /// A circle of the flank on which its sphere touches: where its middle is on the axis, and its radius, mm.
  struct Circle {
    double s, middle, radius;
  };
  [[nodiscard]] const std::vector<Circle>& circles() const { return circles_; }
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] double tip() const { return radii_.front(); }
  [[nodiscard]] double largest() const { return largest_; }
  /// The largest radius between so far below and so far above a place of the axis, mm.
  [[nodiscard]] double largest_near(double s, double far) const;
  /// Of a place at height z over s = 0 and so far from the axis, to the nearest of the spheres, mm; < 0: inside. Exact for cylinders and cones.
  [[nodiscard]] double distance(double z, double off) const;

 private:
  [[nodiscard]] double radius(double s) const;
  double length_, step_, largest_;
  std::vector<double> radii_, slopes_;
  std::vector<Circle> circles_;
};

}  // namespace flank::internal
