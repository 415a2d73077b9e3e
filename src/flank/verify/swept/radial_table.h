/// The radial function as a table of quintics: what the judge's searches evaluate millions of times.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "flank/radial_function.h"

namespace flank::internal::verify {

/// Piecewise quintic that takes r, r' and r'' from the tool at equal steps of s. Exact up to rounding for a cubic
/// spline of equal knots (the cells end on its knots), of sixth order for the closed families. Searches use it;
/// reported values come from the tool itself.
class RadialTable {
 public:
  /// Throws InputError if the length is not > 0 or r is not finite.
  explicit RadialTable(const RadialFunction& radial);

  /// r, r', r'' at s in [0, L].
  [[nodiscard]] RadialJet at(double s) const {
    // Outside [0, L] the end cell's quintic is extrapolated: Newton steps may leave the axis for a moment.
    const double x = s * cells_per_mm_;
    const int i = x > 0.0 ? std::min(static_cast<int>(x), count_ - 1) : 0;
    const double t = x - i;
    const auto& c = cells_[static_cast<std::size_t>(i)];
    RadialJet j;
    j.r = c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5]))));
    j.d1 = (c[1] + t * (2 * c[2] + t * (3 * c[3] + t * (4 * c[4] + t * 5 * c[5])))) * cells_per_mm_;
    j.d2 = (2 * c[2] + t * (6 * c[3] + t * (12 * c[4] + t * 20 * c[5]))) * cells_per_mm_ * cells_per_mm_;
    return j;
  }
  /// r alone.
  [[nodiscard]] double radius(double s) const {
    const double x = s * cells_per_mm_;
    const int i = x > 0.0 ? std::min(static_cast<int>(x), count_ - 1) : 0;
    const double t = x - i;
    const auto& c = cells_[static_cast<std::size_t>(i)];
    return c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5]))));
  }
  /// r at the lower end of cell i, 0 <= i <= count().
  [[nodiscard]] double node_radius(int i) const { return node_radii_[static_cast<std::size_t>(i)]; }
  /// s of the lower end of cell i, mm.
  [[nodiscard]] double node(int i) const { return i / cells_per_mm_; }
  /// Number of cells, their length (mm), and the axis length (mm).
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] double step() const { return 1.0 / cells_per_mm_; }
  [[nodiscard]] double cells_per_mm() const { return cells_per_mm_; }
  [[nodiscard]] double length() const { return length_; }
  /// Smallest and largest r, largest |r''| at the nodes; the radii bound the true ones by half a cell of slope 1.
  [[nodiscard]] double least_radius() const { return least_radius_; }
  [[nodiscard]] double largest_radius() const { return largest_radius_; }
  [[nodiscard]] double largest_bend() const { return largest_bend_; }

 private:
  int count_ = 0;
  double length_ = 0.0, cells_per_mm_ = 0.0;
  double least_radius_ = 0.0, largest_radius_ = 0.0, largest_bend_ = 0.0;
  /// Coefficients by powers of the place in the cell, from 0 to 1.
  std::vector<std::array<double, 6>> cells_;
  std::vector<double> node_radii_;
};

}  // namespace flank::internal::verify
