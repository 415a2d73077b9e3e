/// A B-spline surface cut into its polynomial cells, for fast evaluation.
#pragma once

#include <vector>

#include "flank/bspline_surface.h"

namespace flank::internal {

/// Every knot cell as a polynomial in powers of its own centred coordinates in [-1, 1]; homogeneous where the surface
/// is rational. A bicubic point with all second derivatives takes about 0.1 microseconds. Round-off: a few 1e-15 of the
/// surface's size for degrees up to 5.
class BSplinePatches {
 public:
  BSplinePatches() = default;
  /// Takes degrees up to kMaxDegree; the cost is that of one basis evaluation per cell.
  explicit BSplinePatches(const BSplineSurface& surface);

  /// Ends of the cells: cell (i, j) is [breaks_u()[i], breaks_u()[i + 1]] x [breaks_v()[j], breaks_v()[j + 1]].
  [[nodiscard]] const std::vector<double>& breaks_u() const { return u_.breaks; }
  [[nodiscard]] const std::vector<double>& breaks_v() const { return v_.breaks; }
  /// Number of cells per direction; empty knot spans make none.
  [[nodiscard]] int cells_u() const { return static_cast<int>(u_.breaks.size()) - 1; }
  [[nodiscard]] int cells_v() const { return static_cast<int>(v_.breaks.size()) - 1; }

  /// The cell that holds a parameter, breaks[k] <= u < breaks[k + 1]; the end cells outside the domain and at its upper
  /// end.
  [[nodiscard]] int cell_u(double u) const { return u_.find(u); }
  [[nodiscard]] int cell_v(double v) const { return v_.find(v); }

  /// Point and derivatives of cell (i, j)'s polynomial at (u, v), which may lie outside the cell.
  void evaluate(int i, int j, double u, double v, SurfaceJet& jet) const;
  /// The same by the cell that holds (u, v): outside the domain, the polynomial of the nearest end cell.
  [[nodiscard]] SurfaceJet jet(double u, double v) const {
    SurfaceJet result;
    evaluate(cell_u(u), cell_v(v), u, v, result);
    return result;
  }

  /// Bezier control points of the part [u0, u1] x [v0, v1] of cell (i, j), u index major, (degree_u + 1) x (degree_v +
  /// 1): their convex hull holds that part (weights must be positive).
  [[nodiscard]] std::vector<Vec3> hull(int i, int j, double u0, double u1, double v0, double v1) const;

  [[nodiscard]] int degree_u() const { return u_.degree; }
  [[nodiscard]] int degree_v() const { return v_.degree; }

 private:
  /// One direction: its cells, and a table that finds the cell of a parameter in constant time.
  struct Axis {
    int degree = 0;
    /// Ends of the cells; middle and 1 / half width of each cell.
    std::vector<double> breaks, mid, inverse_half;
    std::vector<int> start;  ///< first cell of each slot of a uniform table
    /// Slots of the table per unit of the parameter: two per cell on average.
    double slots_per_unit = 0.0;

    Axis() = default;
    Axis(int degree_, int count, const std::vector<double>& knots);
    [[nodiscard]] int find(double u) const;
  };
  /// The Horner scheme for one degree in u (bspline_patches.cpp): chosen once, not per evaluation.
  using Kernel = void (*)(const double* c, int p, int q, double s, double t, double* out);

  /// Coefficients of cell (i, j).
  [[nodiscard]] const double* cell(int i, int j) const {
    return coefficients_.data() + static_cast<std::size_t>(i * cells_v() + j) * cell_size_;
  }

  /// The two directions.
  Axis u_, v_;
  bool rational_ = false;
  /// Doubles per cell: 4 (degree_u + 1) (degree_v + 1).
  std::size_t cell_size_ = 0;
  std::vector<double> coefficients_;  ///< of a cell: [power of u][power of v][x, y, z, weight]
  Kernel kernel_ = nullptr;
};

}  // namespace flank::internal
