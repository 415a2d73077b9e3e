/// Distance from a point to the tool in the tool's own plane: g(z, rho) = min over s in [0, L] of sqrt((z - s)^2 +
/// rho^2) - r(s), the inner minimum of MATH section 9. It depends on the tool alone, so it is prepared once.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "flank/verify/swept/radial_table.h"
#include "flank/verify/swept/range_maximum.h"
#include "flank/verify/swept/tool_grid.h"

namespace flank::internal::verify {

/// The sphere that is nearest to a point of the tool plane.
struct NearestSphere {
  double g = 0.0;  ///< signed distance to the tool, mm
  double s = 0.0;  ///< centre of the sphere on the axis, mm, in [0, L]
};

/// A straight line at or above r(s) between two places of the axis.
struct RadiusLine {
  double first = 0.0, last = 0.0;  ///< mm
  double at_zero = 0.0, per_mm = 0.0;

  /// The least of sqrt((z - s)^2 + rho^2) less the line and less `more` + `more_per_mm` s: convex in s.
  [[nodiscard]] double least(double z, double rho, double more, double more_per_mm) const {
    const double slope = per_mm + more_per_mm, squared = 1.0 - slope * slope;
    double s = slope > 0.0 ? last : first;
    if (squared > 0.0) s = std::clamp(z + rho * slope / std::sqrt(squared), first, last);
    return std::sqrt((z - s) * (z - s) + rho * rho) - at_zero - more - slope * s;
  }
};
/// Few of them, as close to r as a small share of the smallest radius where that takes no more than eight.
[[nodiscard]] std::vector<RadiusLine> radius_lines(const RadialTable& radial);

/// z and rho >= 0 are the point's place in the tool's own frame: along the axis from the tip, and from the axis
/// (plane_point). Immutable after construction, so many threads may ask at once.
class ToolDistance {
 public:
  /// Tabulates the tool; throws as RadialTable does.
  explicit ToolDistance(const RadialFunction& radial);

  /// Cheap; the bound falls short of g by about 0.001 of the distance to the axis. Why it is a bound: see tool_grid.cpp.
  [[nodiscard]] Estimate estimate(double z, double rho) const {
    const ToolGrid* grid = grid_around(z, rho);
    return grid != nullptr ? grid->interpolate(z, rho) : beyond_grids(z, rho);
  }
  /// Below the distance to the tool with all radii larger by what goes evenly from `low` at the tip to `high` at the upper end, mm.
  [[nodiscard]] double least_of_wider(double z, double rho, double low, double high) const {
    const double per_mm = (high - low) / radial_.length();
    double least = 1e300;
    for (const RadiusLine& line : lines_) least = std::min(least, line.least(z, rho, low, per_mm));
    return least;
  }
  /// The global minimum over s, to about 1e-12 mm: by the grid and Newton's method if one minimum is certain, else by
  /// search().
  [[nodiscard]] NearestSphere nearest(double z, double rho) const;
  /// The global minimum over s by a search through all of [0, L] that uses no grid.
  [[nodiscard]] NearestSphere search(double z, double rho) const;

  static constexpr int kMostMinima = 16;  ///< more are left out: no real meridian has as many waves
  /// Where the local minima over s below a value are, about: nodes of the radial table. Returns how many.
  [[nodiscard]] int minima(double z, double rho, double below, std::array<double, kMostMinima>& s) const;

  [[nodiscard]] const RadialTable& radial() const { return radial_; }
  /// Upper bound of r''/(1 - r'^2)^(3/2) over s, at least 0. For rho times this under 1 there is one local minimum over
  /// s at most.
  [[nodiscard]] double focal_curvature() const { return focal_curvature_; }
  /// The same over the spheres alone that can be nearer than `below`: of the minima lower than that there is one at most
  /// where rho times this is under 1. A peak at one end of a meridian does not make minima elsewhere.
  [[nodiscard]] double focal_curvature(double z, double rho, double below) const;

 private:
  /// Cells of the radial table; none where last < first.
  struct Cells {
    int first = 0, last = -1;
  };
  /// Those that hold the centres of all spheres nearer than `below`, if none is larger than `largest`.
  [[nodiscard]] Cells cells_below(double z, double rho, double below, double largest) const;
  /// The same with the largest radius that there is within reach.
  [[nodiscard]] Cells cells_nearer(double z, double rho, double below) const;
  [[nodiscard]] NearestSphere narrow(double z, double rho, int node) const;
  /// nearest() where several minima over s may compete.
  [[nodiscard]] NearestSphere nearest_of_several(const ToolGrid& grid, double z, double rho) const;
  [[nodiscard]] const ToolGrid* grid_around(double z, double rho) const {
    for (const ToolGrid& grid : grids_)
      if (grid.contains(z, rho)) return &grid;
    return nullptr;
  }
  [[nodiscard]] Estimate beyond_grids(double z, double rho) const;

  RadialTable radial_;
  std::vector<RadiusLine> lines_;  ///< above r, one after the other from the tip to the upper end
  RangeMaximum bends_, radii_;     ///< focal curvature and radius in each cell of the radial table
  double focal_curvature_ = 0.0;
  std::array<ToolGrid, kToolGrids> grids_;
};

}  // namespace flank::internal::verify
