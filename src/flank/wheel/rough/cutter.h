/// A tool as roughing asks it: how far a place is from it, and the circles of its flank.
#pragma once

#include <algorithm>
#include <cmath>
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
  [[nodiscard]] double distance(double z, double off) const {
    const double s = std::clamp(z + off * leans_[piece(z)], 0.0, length_);
    return std::sqrt(off * off + (z - s) * (z - s)) - radius(s);
  }

 private:
  static constexpr int kPieces = 64;  ///< of the axis
  [[nodiscard]] std::size_t piece(double s) const {
    return static_cast<std::size_t>(std::clamp(s / step_, 0.0, static_cast<double>(kPieces - 1)));
  }
  [[nodiscard]] double radius(double s) const {
    const std::size_t k = piece(s);
    return radii_[k] + (s / step_ - static_cast<double>(k)) * (radii_[k + 1] - radii_[k]);
  }
  double length_, step_, largest_;
  std::vector<double> radii_, leans_;  ///< how far up the sphere is that touches what is 1 mm off the axis
  std::vector<Circle> circles_;
};

}  // namespace flank::internal
