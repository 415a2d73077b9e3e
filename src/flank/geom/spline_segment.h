/// Cutting pieces out of splines by knot insertion.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace flank::internal {

/// A spline of any dimension: one column a control point (homogeneous where rational). The knots need not be clamped.
struct SplineRows {
  int degree = 0;
  std::vector<double> knots;
  Eigen::MatrixXd poles;

  [[nodiscard]] double first() const { return knots[static_cast<std::size_t>(degree)]; }
  [[nodiscard]] double last() const { return knots[static_cast<std::size_t>(poles.cols())]; }
};

/// Ends nearer to a knot than this share of the domain are the knot's.
inline constexpr double kSameKnot = 1e-9;

/// The same function over [a, b] with clamped knots, exactly (Boehm's knot insertion; Piegl and Tiller, 5.2). Ends
/// outside the domain are moved to its ends, ends within rounding of a knot to that knot: a knot beside it would leave
/// a sliver of a span. [a, b] must be longer than 2 kSameKnot of the domain.
[[nodiscard]] SplineRows spline_segment(SplineRows rows, double a, double b);

/// A closed spline followed by itself, `period` later: what a piece across the seam is cut out of. The knots must be
/// clamped.
[[nodiscard]] SplineRows two_turns(const SplineRows& rows, double period);

}  // namespace flank::internal
