#include "flank/geom/trim.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

/// Loops that stay this close to the rectangle's border (as a share of it) and enclose it bound the whole rectangle.
constexpr double kOnBorder = 1e-6;
/// Halvings of one knot span at most: 16,384 chords, so that a curve with a kink comes to an end.
constexpr int kMaxFlattenDepth = 14;
/// Rows at most, so that a loop of many thousand segments takes no more memory.
constexpr int kMaxRows = 4096;

/// Distance of p from the line through a and b; from a if they are one point.
double deviation(const Vec2& a, const Vec2& b, const Vec2& p) {
  const Vec2 d = b - a, r = p - a;
  const double length = d.norm();
  return length > 0.0 ? std::abs(d[0] * r[1] - d[1] * r[0]) / length : r.norm();
}

/// Appends the polyline of [t0, t1] without its first point. All points are scaled to the rectangle.
template <class Value>
void flatten(const Value& value, double t0, const Vec2& p0, double t1, const Vec2& p1, int depth,
             std::vector<Vec2>& out) {
  const double middle = 0.5 * (t0 + t1);
  const Vec2 q = value(middle);
  // A parabola's middle deviates most; the quarter points catch what is not like one (an inflection).
  double worst = deviation(p0, p1, q);
  if (worst <= kTrimDeviation)
    worst = std::max(deviation(p0, p1, value(0.75 * t0 + 0.25 * t1)), deviation(p0, p1, value(0.25 * t0 + 0.75 * t1)));
  if (worst <= kTrimDeviation || depth == 0) {
    out.push_back(p1);
    return;
  }
  flatten(value, t0, p0, middle, q, depth - 1, out);
  flatten(value, middle, q, t1, p1, depth - 1, out);
}

/// Positive if the closed polyline runs counter-clockwise.
double signed_area(const std::vector<Vec2>& polyline) {
  double sum = 0.0;
  for (std::size_t k = 0; k < polyline.size(); ++k) {
    const Vec2 &a = polyline[k], &b = polyline[(k + 1) % polyline.size()];
    sum += 0.5 * (a[0] * b[1] - b[0] * a[1]);
  }
  return sum;
}

/// Points are scaled to the rectangle, so its border is that of the unit square.
bool on_unit_border(const Vec2& p) {
  const Vec2 gap = p.cwiseAbs().cwiseMin((p - Vec2::Ones()).cwiseAbs());
  const bool within = p.minCoeff() > -kOnBorder && p.maxCoeff() < 1.0 + kOnBorder;
  return within && gap.minCoeff() <= kOnBorder;
}

/// Whether a segment and a rectangle share a point (clipping after Liang and Barsky).
bool meets(double x0, double y0, double x1, double y1, const ParameterRectangle& r) {
  // Most segments of a row lie off the rectangle, on one side of it, and need no division.
  if ((x0 < r.u0 && x1 < r.u0) || (x0 > r.u1 && x1 > r.u1) || (y0 < r.v0 && y1 < r.v0) || (y0 > r.v1 && y1 > r.v1))
    return false;
  double low = 0.0, high = 1.0;
  const auto clip = [&](double start, double delta, double a, double b) {
    if (delta == 0.0) return start >= a && start <= b;
    double ta = (a - start) / delta, tb = (b - start) / delta;
    if (ta > tb) std::swap(ta, tb);
    low = std::max(low, ta);
    high = std::min(high, tb);
    return low <= high;
  };
  return clip(x0, x1 - x0, r.u0, r.u1) && clip(y0, y1 - y0, r.v0, r.v1);
}

}  // namespace

void TrimRegion::append(const BSplineCurve2& edge, std::vector<Vec2>& polyline) const {
  const Vec2 low(rectangle_.u0, rectangle_.v0), size(rectangle_.u1 - rectangle_.u0, rectangle_.v1 - rectangle_.v0);
  const auto value = [&](double t) -> Vec2 { return (edge.value(t) - low).cwiseQuotient(size); };
  // Span by span: across a knot the curve may have a kink, which flatten() would have to find by halving.
  std::vector<double> knots{edge.first()};
  for (double k : edge.knots)
    if (k > knots.back() && k <= edge.last()) knots.push_back(k);
  polyline.push_back(value(knots.front()));
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    const Vec2 a = polyline.back(), b = value(knots[k + 1]);
    // Straight between its knots already.
    if (edge.degree == 1 && edge.weights.empty())
      polyline.push_back(b);
    else
      flatten(value, knots[k], a, knots[k + 1], b, kMaxFlattenDepth, polyline);
  }
}

TrimRegion::TrimRegion(const std::vector<TrimLoop>& loops, const ParameterRectangle& rectangle)
    : rectangle_(rectangle), box_(rectangle) {
  std::vector<std::vector<Vec2>> polylines;
  for (const TrimLoop& loop : loops) {
    std::vector<Vec2> polyline;
    for (const BSplineCurve2& edge : loop.edges) append(edge, polyline);
    // Two points enclose nothing.
    if (polyline.size() > 2) polylines.push_back(std::move(polyline));
  }
  find_whole(polylines);
  if (whole_) return;
  const auto scale_u = [&](double x) { return rectangle.u0 + x * (rectangle.u1 - rectangle.u0); };
  const auto scale_v = [&](double y) { return rectangle.v0 + y * (rectangle.v1 - rectangle.v0); };
  box_ = {rectangle.u1, rectangle.u0, rectangle.v1, rectangle.v0};
  for (const auto& polyline : polylines)
    for (std::size_t k = 0; k < polyline.size(); ++k) {
      // From the last point back to the first: loops of files may be open by more than rounding.
      const Vec2 &a = polyline[k], &b = polyline[(k + 1) % polyline.size()];
      segments_.push_back({scale_u(a[0]), scale_v(a[1]), scale_u(b[0]), scale_v(b[1])});
      const Segment& s = segments_.back();
      box_.u0 = std::min(box_.u0, s.u0);
      box_.u1 = std::max(box_.u1, s.u0);
      box_.v0 = std::min(box_.v0, s.v0);
      box_.v1 = std::max(box_.v1, s.v0);
    }
  box_.u0 = std::max(box_.u0, rectangle.u0);
  box_.u1 = std::min(box_.u1, rectangle.u1);
  box_.v0 = std::max(box_.v0, rectangle.v0);
  box_.v1 = std::min(box_.v1, rectangle.v1);
  // A border that follows the rectangle's up to round-off is the rectangle's.
  const double eu = kOnBorder * (rectangle.u1 - rectangle.u0), ev = kOnBorder * (rectangle.v1 - rectangle.v0);
  if (box_.u0 < rectangle.u0 + eu) box_.u0 = rectangle.u0;
  if (box_.u1 > rectangle.u1 - eu) box_.u1 = rectangle.u1;
  if (box_.v0 < rectangle.v0 + ev) box_.v0 = rectangle.v0;
  if (box_.v1 > rectangle.v1 - ev) box_.v1 = rectangle.v1;
  fill_rows();
}

void TrimRegion::find_whole(const std::vector<std::vector<Vec2>>& polylines) {
  double area = 0.0;
  whole_ = true;
  for (const auto& polyline : polylines) {
    area += signed_area(polyline);
    whole_ = whole_ && std::all_of(polyline.begin(), polyline.end(), on_unit_border);
  }
  // The area tells a loop round the whole rectangle from one that runs along a part of its border and back.
  whole_ = polylines.empty() || (whole_ && std::abs(std::abs(area) - 1.0) < 16.0 * kOnBorder);
}

int TrimRegion::row(double v) const {
  const double x = (v - box_.v0) * rows_per_unit_;
  return std::clamp(static_cast<int>(x), 0, static_cast<int>(row_start_.size()) - 2);
}

void TrimRegion::fill_rows() {
  // About two segments begin in each row: inside() then looks at a handful, whatever the loop's length.
  const int rows = std::clamp(static_cast<int>(segments_.size()) / 2, 8, kMaxRows);
  rows_per_unit_ = box_.v1 > box_.v0 ? rows / (box_.v1 - box_.v0) : 0.0;
  std::vector<std::vector<int>> lists(static_cast<std::size_t>(rows));
  row_start_.assign(static_cast<std::size_t>(rows) + 1, 0);
  for (std::size_t k = 0; k < segments_.size(); ++k) {
    const Segment& s = segments_[k];
    const int last = row(std::max(s.v0, s.v1));
    for (int r = row(std::min(s.v0, s.v1)); r <= last; ++r)
      lists[static_cast<std::size_t>(r)].push_back(static_cast<int>(k));
  }
  for (std::size_t r = 0; r < lists.size(); ++r) {
    row_items_.insert(row_items_.end(), lists[r].begin(), lists[r].end());
    row_start_[r + 1] = static_cast<int>(row_items_.size());
  }
}

bool TrimRegion::inside(double u, double v) const {
  // Most points asked for lie far off: they need no row.
  if (u < box_.u0 || u > box_.u1 || v < box_.v0 || v > box_.v1) return false;
  if (whole_) return true;
  const auto r = static_cast<std::size_t>(row(v));
  bool odd = false;
  for (int k = row_start_[r]; k < row_start_[r + 1]; ++k) {
    const Segment& s = segments_[static_cast<std::size_t>(row_items_[static_cast<std::size_t>(k)])];
    // Half-open in v: a vertex of the polyline on the line v counts once, a horizontal side not at all.
    if ((s.v0 > v) == (s.v1 > v)) continue;
    if (u < s.u0 + (s.u1 - s.u0) * (v - s.v0) / (s.v1 - s.v0)) odd = !odd;
  }
  return odd;
}

TrimRegion::Side TrimRegion::classify(const ParameterRectangle& r) const {
  if (r.u1 < box_.u0 || r.u0 > box_.u1 || r.v1 < box_.v0 || r.v0 > box_.v1) return Side::kOutside;
  if (whole_) {
    const bool within = r.u0 >= box_.u0 && r.u1 <= box_.u1 && r.v0 >= box_.v0 && r.v1 <= box_.v1;
    return within ? Side::kInside : Side::kCut;
  }
  const int last = row(r.v1);
  for (int k = row_start_[static_cast<std::size_t>(row(r.v0))]; k < row_start_[static_cast<std::size_t>(last) + 1];
       ++k) {
    const Segment& s = segments_[static_cast<std::size_t>(row_items_[static_cast<std::size_t>(k)])];
    if (meets(s.u0, s.v0, s.u1, s.v1, r)) return Side::kCut;
  }
  // No loop passes through it, so one point decides for all of it.
  return inside(0.5 * (r.u0 + r.u1), 0.5 * (r.v0 + r.v1)) ? Side::kInside : Side::kOutside;
}

BSplineCurve2 straight_edge(const Vec2& from, const Vec2& to) {
  BSplineCurve2 edge;
  edge.degree = 1;
  edge.knots = {0.0, 0.0, 1.0, 1.0};
  edge.poles.resize(2, 2);
  edge.poles << from, to;
  return edge;
}

TrimLoop rectangle_loop(const ParameterRectangle& r) {
  const std::array<Vec2, 4> corners{Vec2(r.u0, r.v0), Vec2(r.u1, r.v0), Vec2(r.u1, r.v1), Vec2(r.u0, r.v1)};
  TrimLoop loop;
  for (std::size_t k = 0; k < 4; ++k) loop.edges.push_back(straight_edge(corners[k], corners[(k + 1) % 4]));
  return loop;
}

}  // namespace flank::internal
