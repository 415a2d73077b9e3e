#include "flank/motion/rail_bounds.h"

#include <algorithm>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

/// Blossom of the polynomial piece of `span` at p arguments: `low` p - k times and `high` k times (de Boor's triangle
/// with one argument a level). For k = 0..p these are the Bezier points of that piece over [low, high].
Vec3 bezier_point(const BSplineCurve3& curve, int span, double low, double high, int k) {
  const int p = curve.degree;
  std::array<Vec3, kMaxDegree + 1> d;
  for (int j = 0; j <= p; ++j) d[j] = curve.poles.col(span - p + j);
  for (int level = 1; level <= p; ++level) {
    const double argument = level <= k ? high : low;
    for (int j = p; j >= level; --j) {
      const double a = curve.knots[span - p + j], b = curve.knots[span + 1 + j - level];
      const double share = (argument - a) / (b - a);
      d[j] = (1.0 - share) * d[j - 1] + share * d[j];
    }
  }
  return d[p];
}

/// Calls visit(point) for the Bezier points of every polynomial piece that meets [t0, t1].
template <class Visit>
void for_each_bezier_point(const BSplineCurve3& curve, double t0, double t1, Visit visit) {
  const int first = find_span(curve.degree, curve.knots, t0), last = find_span(curve.degree, curve.knots, t1);
  for (int span = first; span <= last; ++span) {
    if (curve.knots[span] == curve.knots[span + 1]) continue;
    const double low = span == first ? t0 : curve.knots[span];
    const double high = span == last ? t1 : curve.knots[span + 1];
    for (int k = 0; k <= curve.degree; ++k) visit(bezier_point(curve, span, low, high, k));
  }
}

}  // namespace

BSplineCurve3 derivative(const BSplineCurve3& curve) {
  FLANK_ASSERT(curve.degree >= 1 && curve.weights.empty());
  const int p = curve.degree;
  BSplineCurve3 d;
  d.degree = p - 1;
  d.knots.assign(curve.knots.begin() + 1, curve.knots.end() - 1);
  d.poles.resize(3, curve.count() - 1);
  for (int i = 0; i + 1 < curve.count(); ++i) {
    const double width = curve.knots[i + p + 1] - curve.knots[i + 1];
    // A full-multiplicity interior knot gives an empty width; its pole acts on no interval.
    d.poles.col(i) = width > 0.0 ? Vec3(p * (curve.poles.col(i + 1) - curve.poles.col(i)) / width) : Vec3::Zero();
  }
  return d;
}

double largest_norm(const BSplineCurve3& curve, double t0, double t1) {
  FLANK_ASSERT(t0 <= t1 && curve.weights.empty());
  double largest = 0.0;
  for_each_bezier_point(curve, t0, t1, [&](const Vec3& b) { largest = std::max(largest, b.norm()); });
  return largest;
}

double smallest_component(const BSplineCurve3& curve, const Vec3& direction, double t0, double t1) {
  FLANK_ASSERT(t0 <= t1 && curve.weights.empty());
  double smallest = std::numeric_limits<double>::infinity();
  for_each_bezier_point(curve, t0, t1, [&](const Vec3& b) { smallest = std::min(smallest, b.dot(direction)); });
  return smallest;
}

}  // namespace flank::internal
