/// Grids over the tool plane: at each place (z, rho) a lower bound of g, the distance to the tool (tool_distance.h), and about
/// where the nearest sphere sits, without evaluating the tool.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "flank/verify/swept/radial_table.h"

namespace flank::internal::verify {

/// What is known of g at a place without evaluating the tool.
struct Estimate {
  double bound = 0.0;    ///< <= g
  double s = 0.0;        ///< about the minimiser
  double s_error = 0.0;  ///< s is this near to the minimiser if there is only one
  bool near_end = true;  ///< s may be held by an end of the axis
  double cell = 0.0;     ///< how far the places from which s is interpolated are at most, mm
};

/// Nodes at equal steps over [z_first, z_last] x [0, rho_last], mm.
struct ToolGrid {
  struct Node {
    float bound;  ///< below g at the node by the largest interpolation error of the cells around it
    float s;      ///< the global minimiser at the node
  };
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
  /// Bilinear. The bound never exceeds g: why, see tool_grid.cpp.
  [[nodiscard]] Estimate interpolate(double z, double rho) const {
    double fz = 0.0, fr = 0.0;
    const Node* a = cell(z, rho, fz, fr);
    const Node* b = a + columns;
    const double w00 = (1.0 - fz) * (1.0 - fr), w01 = fz * (1.0 - fr), w10 = (1.0 - fz) * fr, w11 = fz * fr;
    const double s = w00 * a[0].s + w01 * a[1].s + w10 * b[0].s + w11 * b[1].s;
    // Where s runs into an end of the axis its interpolation has a kink.
    const bool near_end = s < 2.0 * z_step || s > s_end;
    return {w00 * a[0].bound + w01 * a[1].bound + w10 * b[0].bound + w11 * b[1].bound, s,
            (near_end ? 0.3 : 0.03) * z_step, near_end, z_step + rho_step};
  }
};

inline constexpr int kToolGrids = 5;
/// The grids of a tool, from fine and near to coarse and far; each holds the one before it.
[[nodiscard]] std::array<ToolGrid, kToolGrids> tool_grids(const RadialTable& radial);

}  // namespace flank::internal::verify
