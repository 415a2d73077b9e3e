#include "flank/verify/swept/tool_grid.h"

#include <cmath>

#include "flank/verify/swept/sphere_distance.h"

namespace flank::internal::verify {
namespace {

/// Cells of the grids along z and across. The finest is where samples lie that the tool touches; farther away the error
/// of the interpolation, cell^2 / (8 D), grows no faster than the distance D, so fewer cells do. All of it takes some
/// 300 kB.
constexpr int kNearColumns = 320, kNearRows = 56;
constexpr int kFarColumns = 96, kFarRows = 40;
constexpr double kNearMarginRadii = 1.25;  ///< the finest grid reaches this many largest radii beyond flank and ends
constexpr double kFarther = 3.0;           ///< each grid reaches this much farther than the last
/// Relative rounding of the nodes, which are floats (6e-8), with a reserve: bounds must not exceed g.
constexpr double kFloatRounding = 1e-6;

// For each s the value is convex in (z, rho) with second derivatives at most 1/D, so g less |(z, rho)|^2/(2 D) is
// concave while D, the distance to the axis segment, is bounded below; a bilinear interpolant of a concave function
// lies below it. Hence the interpolant exceeds g by at most (dz^2 + d_rho^2)/(8 D) in a cell. Close to the axis the
// slope, at most 1, bounds it instead.
double interpolation_error(const RadialTable& radial, const ToolGrid& grid, double z, double rho) {
  const double beyond = std::max({-z - grid.z_step, z - grid.z_step - radial.length(), 0.0});
  const double distance = std::hypot(beyond, std::max(0.0, rho - grid.rho_step));
  const double squares = grid.z_step * grid.z_step + grid.rho_step * grid.rho_step;
  const double lipschitz = std::sqrt(squares);
  return distance > 0.0 ? std::min(lipschitz, squares / (8.0 * distance)) : lipschitz;
}

// For a fixed rho the minimising s grows with z (the cost is convex in z - s), so the best nodes of a row are found by
// halving.
void best_nodes(const RadialTable& radial, const ToolGrid& grid, double rho, std::vector<int>& best) {
  best.assign(static_cast<std::size_t>(grid.columns), 0);
  struct Range {
    int first, last, low, high;
  };
  std::vector<Range> stack{{0, grid.columns - 1, 0, radial.count()}};
  while (!stack.empty()) {
    const Range range = stack.back();
    stack.pop_back();
    const int middle = (range.first + range.last) / 2;
    const double z = grid.z_first + middle * grid.z_step;
    int argument = range.low;
    double least = 1e300;
    for (int k = range.low; k <= range.high; ++k) {
      const double dz = z - radial.node(k);
      const double v = std::sqrt(dz * dz + rho * rho) - radial.node_radius(k);
      if (v < least) least = v, argument = k;
    }
    best[static_cast<std::size_t>(middle)] = argument;
    if (range.first < middle) stack.push_back({range.first, middle - 1, range.low, argument});
    if (middle < range.last) stack.push_back({middle + 1, range.last, argument, range.high});
  }
}

ToolGrid make_grid(const RadialTable& radial, double margin, double reach, int cells_z, int cells_rho) {
  ToolGrid grid;
  grid.z_first = -margin;
  grid.z_last = radial.length() + margin;
  grid.rho_last = reach;
  grid.columns = cells_z + 1;
  grid.rows = cells_rho + 1;
  grid.z_step = (grid.z_last - grid.z_first) / cells_z;
  grid.rho_step = reach / cells_rho;
  grid.z_scale = 1.0 / grid.z_step;
  grid.rho_scale = 1.0 / grid.rho_step;
  grid.s_end = radial.length() - 2.0 * grid.z_step;
  grid.nodes.reserve(static_cast<std::size_t>(grid.columns * grid.rows));
  const double h = radial.step();
  std::vector<int> best;
  for (int row = 0; row < grid.rows; ++row) {
    const double rho = row * grid.rho_step;
    best_nodes(radial, grid, rho, best);
    for (int column = 0; column < grid.columns; ++column) {
      const double z = grid.z_first + column * grid.z_step;
      double s = radial.node(best[static_cast<std::size_t>(column)]);
      double g = sphere_distance(radial, z, rho, s);
      // What the nodes of the radial table may miss between them: half a step of slope 2, or the bend of the value over
      // a step.
      double missed = h;
      double polished = s;
      if (polish_sphere(radial, z, rho, polished) && sphere_distance(radial, z, rho, polished) <= g) {
        s = polished, g = sphere_distance(radial, z, rho, polished);
        const double distance = std::hypot(std::max({-z, z - radial.length(), 0.0}), rho);
        if (distance > 0.0) missed = std::min(h, h * h / 8.0 * (1.0 / distance + 2.0 * radial.largest_bend()));
      }
      const double rounding = kFloatRounding * (1.0 + std::abs(g));
      grid.nodes.push_back({static_cast<float>(g - interpolation_error(radial, grid, z, rho) - missed - rounding),
                            static_cast<float>(s)});
    }
  }
  return grid;
}

}  // namespace

std::array<ToolGrid, kToolGrids> tool_grids(const RadialTable& radial) {
  std::array<ToolGrid, kToolGrids> grids;
  const double radius = radial.largest_radius();
  double margin = kNearMarginRadii * radius;
  for (int k = 0; k < kToolGrids; ++k, margin *= kFarther)
    grids[static_cast<std::size_t>(k)] =
        make_grid(radial, margin, radius + margin, k == 0 ? kNearColumns : kFarColumns, k == 0 ? kNearRows : kFarRows);
  return grids;
}

}  // namespace flank::internal::verify
