#include "flank/verify/swept/radial_table.h"

#include <algorithm>
#include <cmath>

#include "flank/error.h"

namespace flank::internal::verify {
namespace {

/// Cells of the table. Error of the quintic: r^(6) h^6 / 46080, below 1e-12 mm for an arc of 50 mm and 0.2 mm cells.
constexpr int kCells = 192;

/// Quintic on [0, 1] with value, first and second derivative p at 0 and q at 1 (derivatives already per cell).
std::array<double, 6> quintic(const RadialJet& p, const RadialJet& q) {
  const double d = q.r - p.r - p.d1 - 0.5 * p.d2;
  const double e = q.d1 - p.d1 - p.d2;
  const double g = q.d2 - p.d2;
  return {p.r, p.d1, 0.5 * p.d2, 10 * d - 4 * e + 0.5 * g, -15 * d + 7 * e - g, 6 * d - 3 * e + 0.5 * g};
}

/// A cubic spline's cells end on its knots: across a knot its third derivative jumps, and no quintic would follow that.
int cell_count(const RadialFunction& radial) {
  if (radial.family() != ToolFamily::kSpline) return kCells;
  const int spans = std::max(1, radial.parameter_count() - 3);
  return spans * ((kCells + spans - 1) / spans);
}

}  // namespace

RadialTable::RadialTable(const RadialFunction& radial) : count_(cell_count(radial)), length_(radial.axis_length()) {
  if (!(length_ > 0.0)) throw InputError("tool: the axis length must be > 0 mm");
  cells_per_mm_ = count_ / length_;
  const double h = 1.0 / cells_per_mm_;
  std::vector<RadialJet> nodes;
  for (int i = 0; i <= count_; ++i) {
    RadialJet j = radial.at(std::min(length_, i * h));
    if (!std::isfinite(j.r)) throw InputError("tool: the radius is not finite at s = " + std::to_string(i * h) + " mm");
    node_radii_.push_back(j.r);
    largest_bend_ = std::max(largest_bend_, std::abs(j.d2));
    nodes.push_back({j.r, j.d1 * h, j.d2 * h * h});
  }
  for (int i = 0; i < count_; ++i) cells_.push_back(quintic(nodes[i], nodes[i + 1]));
  const auto [low, high] = std::minmax_element(node_radii_.begin(), node_radii_.end());
  // |r'| < 1, so between two nodes, at most half a cell from either, r leaves their values by at most that.
  least_radius_ = *low - 0.5 * h;
  largest_radius_ = *high + 0.5 * h;
}

}  // namespace flank::internal::verify
