#include "flank/geom/spline_segment.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

double nearest_knot(const SplineRows& rows, double t) {
  const double tolerance = kSameKnot * (rows.last() - rows.first());
  t = std::clamp(t, rows.first(), rows.last());
  for (const double knot : rows.knots)
    if (std::abs(knot - t) <= tolerance) return std::clamp(knot, rows.first(), rows.last());
  return t;
}

void insert_knot(SplineRows& rows, double t) {
  const int p = rows.degree;
  const auto upper = std::upper_bound(rows.knots.begin(), rows.knots.end(), t);
  const int span = static_cast<int>(upper - rows.knots.begin()) - 1;
  const int multiplicity = static_cast<int>(std::count(rows.knots.begin(), rows.knots.end(), t));
  Eigen::MatrixXd poles(rows.poles.rows(), rows.poles.cols() + 1);
  for (int i = 0; i < poles.cols(); ++i) {
    if (i <= span - p) {
      poles.col(i) = rows.poles.col(i);
    } else if (i > span - multiplicity) {
      poles.col(i) = rows.poles.col(i - 1);
    } else {
      const double low = rows.knots[static_cast<std::size_t>(i)], high = rows.knots[static_cast<std::size_t>(i + p)];
      const double share = (t - low) / (high - low);
      poles.col(i) = share * rows.poles.col(i) + (1.0 - share) * rows.poles.col(i - 1);
    }
  }
  rows.poles = std::move(poles);
  rows.knots.insert(upper, t);
}

void fill_knot(SplineRows& rows, double t) {
  for (auto n = std::count(rows.knots.begin(), rows.knots.end(), t); n < rows.degree; ++n) insert_knot(rows, t);
}

}  // namespace

SplineRows spline_segment(SplineRows rows, double a, double b) {
  a = nearest_knot(rows, a);
  b = nearest_knot(rows, b);
  fill_knot(rows, a);
  fill_knot(rows, b);
  const std::ptrdiff_t p = rows.degree;
  const auto begin = rows.knots.begin();
  // At a knot of full multiplicity the spline passes through a control point: the piece begins and ends with it.
  const std::ptrdiff_t first = std::upper_bound(begin, rows.knots.end(), a) - begin - 1 - p;
  const std::ptrdiff_t end = std::lower_bound(begin, rows.knots.end(), b) - begin;
  SplineRows piece{rows.degree, {a}, rows.poles.middleCols(first, end - first)};
  piece.knots.insert(piece.knots.end(), begin + first + 1, begin + end + p);
  piece.knots.push_back(b);
  return piece;
}

SplineRows two_turns(const SplineRows& rows, double period) {
  const Eigen::Index count = rows.poles.cols();
  SplineRows twice{
      rows.degree, {rows.knots.begin(), rows.knots.end() - 1}, Eigen::MatrixXd(rows.poles.rows(), 2 * count - 1)};
  twice.poles << rows.poles, rows.poles.rightCols(count - 1);
  for (auto knot = rows.knots.begin() + rows.degree + 1; knot != rows.knots.end(); ++knot)
    twice.knots.push_back(*knot + period);
  return twice;
}

}  // namespace flank::internal
