/// Distance from a point to the tool in the tool's own plane: g(z, rho) = min over s in [0, L] of sqrt((z - s)^2 +
/// rho^2) - r(s), the inner minimum of MATH section 9. It depends on the tool alone, so it is prepared once.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "flank/verify/swept/radial_table.h"

namespace flank::internal::verify {

/// The sphere that is nearest to a point of the tool plane.
struct NearestSphere {
  double g = 0.0;  ///< signed distance to the tool, mm
  double s = 0.0;  ///< centre of the sphere on the axis, mm, in [0, L]
  /// Another local minimum over s may be as good a small step away from (z, rho): the caller must not follow s by
  /// continuity.
  bool contested = false;
};

/// What the grid knows without evaluating the tool: a lower bound of g, and about where the nearest sphere sits.
struct Estimate {
  double bound = 0.0;    ///< <= g
  double s = 0.0;        ///< about the minimiser
  double s_error = 0.0;  ///< s is this near to the minimiser if there is only one
  bool near_end = true;  ///< s may be held by an end of the axis
};

/// z and rho >= 0 are the point's place in the tool's own frame: along the axis from the tip, and from the axis
/// (plane_point). Immutable after construction, so many threads may ask at once.
class ToolDistance {
 public:
  /// Tabulates the tool; throws as RadialTable does.
  explicit ToolDistance(const RadialFunction& radial);

  /// Cheap; the bound falls short of g by about 0.001 of the distance to the axis. Why it is a bound: see
  /// tool_grid.cpp.
  [[nodiscard]] Estimate estimate(double z, double rho) const {
    const Grid* grid = grid_around(z, rho);
    return grid != nullptr ? grid->interpolate(z, rho) : beyond_grids(z, rho);
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

 private:
  struct Node {
    float bound;  ///< below g at the node by the largest interpolation error of the cells around it
    float s;      ///< the global minimiser at the node
  };
  /// Nodes at equal steps over [z_first, z_last] x [0, rho_last].
  struct Grid {
    double z_first = 0.0, z_last = 0.0, rho_last = 0.0;
    double z_step = 0.0, rho_step = 0.0, z_scale = 0.0, rho_scale = 0.0;
    double s_end = 0.0;         ///< two steps below L
    int columns = 0, rows = 0;  ///< nodes along z and along rho
    std::vector<Node> nodes;    ///< node (row, column) at row * columns + column

    /// Whether the point is inside the grid.
    [[nodiscard]] bool contains(double z, double rho) const { return z > z_first && z < z_last && rho < rho_last; }
    /// The lower corner of the cell that holds the point, and the point's place in it, from 0 to 1.
    [[nodiscard]] const Node* cell(double z, double rho, double& fz, double& fr) const {
      const double x = (z - z_first) * z_scale, y = rho * rho_scale;
      const int column = std::min(static_cast<int>(x), columns - 2);
      const int row = std::min(static_cast<int>(y), rows - 2);
      fz = x - column;
      fr = y - row;
      return &nodes[static_cast<std::size_t>(row * columns + column)];
    }
    /// Bilinear.
    [[nodiscard]] Estimate interpolate(double z, double rho) const {
      double fz = 0.0, fr = 0.0;
      const Node* a = cell(z, rho, fz, fr);
      const Node* b = a + columns;
      const double w00 = (1.0 - fz) * (1.0 - fr), w01 = fz * (1.0 - fr), w10 = (1.0 - fz) * fr, w11 = fz * fr;
      const double s = w00 * a[0].s + w01 * a[1].s + w10 * b[0].s + w11 * b[1].s;
      // Where s runs into an end of the axis its interpolation has a kink.
      const bool near_end = s < 2.0 * z_step || s > s_end;
      return {w00 * a[0].bound + w01 * a[1].bound + w10 * b[0].bound + w11 * b[1].bound, s,
              (near_end ? 0.3 : 0.03) * z_step, near_end};
    }
  };

  /// Distance to the sphere of s.
  [[nodiscard]] double value(double z, double rho, double s) const;
  /// Newton's method on s; false if it does not converge.
  [[nodiscard]] bool polish(double z, double rho, double& s) const;
  [[nodiscard]] NearestSphere narrow(double z, double rho, int node) const;
  [[nodiscard]] const Grid* grid_around(double z, double rho) const {
    for (const Grid& grid : grids_)
      if (grid.contains(z, rho)) return &grid;
    return nullptr;
  }
  [[nodiscard]] Estimate beyond_grids(double z, double rho) const;
  void build_grid(Grid& grid, double margin, double reach, int cells_z, int cells_rho) const;
  void best_nodes(const Grid& grid, double rho, std::vector<int>& best) const;
  /// How much a bilinear interpolant may exceed g beside a node.
  [[nodiscard]] double interpolation_error(const Grid& grid, double z, double rho) const;

  static constexpr int kGrids = 5;
  RadialTable radial_;
  double focal_curvature_ = 0.0;
  std::array<Grid, kGrids> grids_;  ///< from fine and near to coarse and far
};

}  // namespace flank::internal::verify
