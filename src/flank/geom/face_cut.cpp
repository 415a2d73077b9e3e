#include "flank/geom/face_cut.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flank/error.h"
#include "flank/geom/spline_segment.h"
#include "flank/geom/trim.h"

namespace flank::internal {
namespace {

/// As a share of the surface's box.
constexpr double kClosedShare = 1e-7;
// What enters and leaves the half plane between two such looks is not seen.
constexpr int kSteps = 16;       ///< an edge is looked at so many times in a knot span for where it crosses a line
constexpr int kBisections = 60;  // of a step: down to the last bit of the parameter

/// Columns along the direction; the other one, homogeneous, below one another.
/// Homogeneous coordinates (w x, w y, w z, w): knots are inserted in them linearly, and a rational surface stays
/// exact.
SplineRows rows_of(const BSplineSurface& s, bool along_u) {
  const int columns = along_u ? s.count_u : s.count_v, others = along_u ? s.count_v : s.count_u;
  SplineRows rows{along_u ? s.degree_u : s.degree_v, along_u ? s.knots_u : s.knots_v,
                  Eigen::MatrixXd(4 * others, columns)};
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < others; ++j) {
      const int at = along_u ? i * s.count_v + j : j * s.count_v + i;
      const double weight = s.weights.empty() ? 1.0 : s.weights[static_cast<std::size_t>(at)];
      rows.poles.block<3, 1>(4 * j, i) = weight * s.poles[static_cast<std::size_t>(at)];
      rows.poles(4 * j + 3, i) = weight;
    }
  }
  return rows;
}

/// The way back: the old surface with the knots and poles of one direction replaced, and weights divided out.
BSplineSurface surface_of(const BSplineSurface& old, bool along_u, const SplineRows& rows) {
  BSplineSurface s = old;
  (along_u ? s.knots_u : s.knots_v) = rows.knots;
  (along_u ? s.count_u : s.count_v) = static_cast<int>(rows.poles.cols());
  s.poles.assign(static_cast<std::size_t>(s.count_u * s.count_v), Vec3::Zero());
  if (!s.weights.empty()) s.weights.assign(s.poles.size(), 1.0);
  for (int i = 0; i < s.count_u; ++i) {
    for (int j = 0; j < s.count_v; ++j) {
      const Eigen::Vector4d pole = along_u ? rows.poles.block<4, 1>(4 * j, i) : rows.poles.block<4, 1>(4 * i, j);
      const auto at = static_cast<std::size_t>(i * s.count_v + j);
      s.poles[at] = s.weights.empty() ? Vec3(pole.head<3>()) : Vec3(pole.head<3>() / pole[3]);
      if (!s.weights.empty()) s.weights[at] = pole[3];
    }
  }
  return s;
}

/// The part of a curve between two of its parameters.
BSplineCurve2 part_of(const BSplineCurve2& c, double a, double b) {
  SplineRows rows{c.degree, c.knots, Eigen::MatrixXd(3, c.count())};
  for (int i = 0; i < c.count(); ++i) {
    const double weight = c.weights.empty() ? 1.0 : c.weights[static_cast<std::size_t>(i)];
    rows.poles.col(i) << weight * c.poles.col(i), weight;
  }
  rows = spline_segment(std::move(rows), a, b);
  BSplineCurve2 part;
  part.degree = c.degree;
  part.knots = std::move(rows.knots);
  part.poles = rows.poles.topRows<2>().array().rowwise() / rows.poles.row(2).array();
  if (!c.weights.empty())
    for (const double w : rows.poles.row(2)) part.weights.push_back(w);
  return part;
}

/// The same points in the opposite direction, over the same interval of parameters.
BSplineCurve2 backwards(const BSplineCurve2& c) {
  BSplineCurve2 r = c;
  const double sum = c.knots.front() + c.knots.back();
  std::transform(c.knots.rbegin(), c.knots.rend(), r.knots.begin(), [&](double k) { return sum - k; });
  r.poles = c.poles.rowwise().reverse();
  std::reverse(r.weights.begin(), r.weights.end());
  return r;
}

/// Edges that follow one another; from the line to the line, if it is cut.
using Chain = std::vector<BSplineCurve2>;

/// A half plane of the parameters.
struct Half {
  int axis = 0;
  double at = 0.0;
  bool above = true;

  // > 0 inside: a point on the line counts as inside, so that a loop which runs along it is not cut into pieces.
  [[nodiscard]] double depth(const Vec2& q) const { return above ? q[axis] - at : at - q[axis]; }
  [[nodiscard]] bool holds(const Vec2& q) const { return depth(q) >= 0.0; }
};

/// The pieces of an edge, alternately inside and outside.
struct Piece {
  BSplineCurve2 curve;
  bool inside = true;
};

/// Cuts an edge where it crosses the line: looked for in steps, knot span by knot span, then by bisection.
std::vector<Piece> pieces_of(const BSplineCurve2& edge, const Half& half) {
  std::vector<double> ends{edge.first()};
  std::vector<double> knots{edge.first()};
  for (const double k : edge.knots)
    if (k > knots.back() && k <= edge.last()) knots.push_back(k);
  bool before = half.holds(edge.value(edge.first()));
  const bool starts_inside = before;
  double from = edge.first();
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    for (int i = 1; i <= kSteps; ++i) {
      const double t = knots[k] + (knots[k + 1] - knots[k]) * i / kSteps;
      const bool now = half.holds(edge.value(t));
      if (now != before) {
        double low = from, high = t;
        for (int n = 0; n < kBisections; ++n) {
          const double middle = 0.5 * (low + high);
          (half.holds(edge.value(middle)) == before ? low : high) = middle;
        }
        // The end that is inside: pieces that are kept then begin and end within the half plane.
        ends.push_back(before ? low : high);
      }
      before = now;
      from = t;
    }
  }
  ends.push_back(edge.last());
  std::vector<Piece> pieces;
  // What is so short may have no length as a segment: the edge then only touches the line there.
  const double least = 2.0 * kSameKnot * (edge.last() - edge.first());
  for (std::size_t k = 0; k + 1 < ends.size(); ++k)
    // By their number, not by asking anew: at a crossing the answer is decided by rounding.
    if (ends[k + 1] - ends[k] > least)
      pieces.push_back({part_of(edge, ends[k], ends[k + 1]), starts_inside == (k % 2 == 0)});
  return pieces;
}

/// The chains of a loop that lie inside; whole: the loop is one of them, closed.
void collect(const TrimLoop& loop, const Half& half, std::vector<Chain>& chains, std::vector<TrimLoop>& whole) {
  std::vector<Piece> pieces;
  for (const BSplineCurve2& edge : loop.edges)
    for (Piece& piece : pieces_of(edge, half)) pieces.push_back(std::move(piece));
  const auto outside = std::find_if(pieces.begin(), pieces.end(), [](const Piece& p) { return !p.inside; });
  if (outside == pieces.end()) {
    whole.push_back(loop);
    return;
  }
  // From an outside piece on, so that no chain goes across the loop's start.
  std::rotate(pieces.begin(), outside, pieces.end());
  bool open = false;
  for (Piece& piece : pieces) {
    // Inside pieces that follow each other are one chain, also across the joint of two edges.
    if (piece.inside && !open) chains.emplace_back();
    open = piece.inside;
    if (piece.inside) chains.back().push_back(std::move(piece.curve));
  }
}

// First and last pole: edges are clamped, so these are points of the curves.
Vec2 start_of(const Chain& chain) { return chain.front().poles.col(0); }
Vec2 end_of(const Chain& chain) { return chain.back().poles.col(chain.back().poles.cols() - 1); }

/// Along the line the inside lies between the first and the second end of chains, the third and the fourth, ...
std::vector<TrimLoop> joined(std::vector<Chain> chains, int axis) {
  struct End {
    double along;
    std::size_t chain;
    bool last;
  };
  std::vector<End> ends;
  for (std::size_t k = 0; k < chains.size(); ++k) {
    ends.push_back({start_of(chains[k])[1 - axis], k, false});
    ends.push_back({end_of(chains[k])[1 - axis], k, true});
  }
  // Such ends have no order.
  if (std::any_of(ends.begin(), ends.end(), [](const End& e) { return !std::isfinite(e.along); }))
    throw InputError("a trim of the face has parameters that are not finite");
  std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
    return std::tie(a.along, a.chain, a.last) < std::tie(b.along, b.chain, b.last);
  });
  const auto place = [&](std::size_t chain, bool last) {
    return static_cast<std::size_t>(
        std::find_if(ends.begin(), ends.end(), [&](const End& e) { return e.chain == chain && e.last == last; }) -
        ends.begin());
  };
  std::vector<char> used(chains.size(), 0);
  std::vector<TrimLoop> loops;
  for (std::size_t first = 0; first < chains.size(); ++first) {
    if (used[first] != 0) continue;
    TrimLoop loop;
    std::size_t chain = first;
    bool backward = false;
    while (used[chain] == 0) {
      used[chain] = 1;
      Chain& now = chains[chain];
      if (backward) {
        std::reverse(now.begin(), now.end());
        for (BSplineCurve2& edge : now) edge = backwards(edge);
      }
      const Vec2 from = end_of(now);
      for (BSplineCurve2& edge : now) loop.edges.push_back(edge);
      // The partner at the line: ends 0 and 1 are a pair, 2 and 3, ... (even-odd rule), so the last bit of the index
      // is flipped.
      const End& next = ends[place(chain, !backward) ^ 1U];
      // The first chain runs forward, so a loop closes at the beginning of its first edge.
      const Vec2 to = next.chain == first ? start_of({loop.edges.front()})
                      : next.last         ? end_of(chains[next.chain])
                                          : start_of(chains[next.chain]);
      if ((to - from).norm() > 0.0) loop.edges.push_back(straight_edge(from, to));
      chain = next.chain;
      backward = next.last;
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

// Poles and weights, not points: equal rows mean equal ends everywhere, without sampling.
bool is_closed(const BSplineSurface& s, bool along_u) {
  Box3 box;
  for (const Vec3& p : s.poles) box.add(p);
  const double same = kClosedShare * box.diagonal();
  const int others = along_u ? s.count_v : s.count_u, last = (along_u ? s.count_u : s.count_v) - 1;
  for (int j = 0; j < others; ++j) {
    const auto at = [&](int i) { return static_cast<std::size_t>(along_u ? i * s.count_v + j : j * s.count_v + i); };
    if ((s.poles[at(0)] - s.poles[at(last)]).norm() > same) return false;
    if (!s.weights.empty() && std::abs(s.weights[at(0)] - s.weights[at(last)]) > kClosedShare * s.weights[at(0)])
      return false;
  }
  return true;
}

BSplineSurface cut_surface(const BSplineSurface& surface, bool along_u, double a, double b) {
  SplineRows rows = rows_of(surface, along_u);
  // A piece across the seam is cut from two copies of the surface, one after the other.
  const double period = rows.last() - rows.first();
  if (b > rows.last() + 1e-9 * period && is_closed(surface, along_u)) rows = two_turns(rows, period);
  return surface_of(surface, along_u, spline_segment(std::move(rows), a, b));
}

std::vector<TrimLoop> cut_loops(const std::vector<TrimLoop>& loops, bool along_u, double at, bool above) {
  const Half half{along_u ? 0 : 1, at, above};
  std::vector<Chain> chains;
  std::vector<TrimLoop> kept;
  for (const TrimLoop& loop : loops) collect(loop, half, chains, kept);
  for (TrimLoop& loop : joined(std::move(chains), half.axis)) kept.push_back(std::move(loop));
  return kept;
}

Face cut_face(const Face& face, bool along_u, double a, double b) {
  Face piece = face;
  piece.surface = cut_surface(face.surface, along_u, a, b);
  // Without trims the face is all of its surface, and the piece all of the cut one.
  if (face.loops.empty()) return piece;
  piece.loops = cut_loops(cut_loops(face.loops, along_u, a, true), along_u, b, false);
  if (piece.loops.empty())
    throw InputError(face.id + ": nothing of the face lies between the two lines that cut a piece from it");
  return piece;
}

}  // namespace flank::internal
