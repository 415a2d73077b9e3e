#include "flank/surface/nurbs/nurbs_border.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

constexpr int kSamples = 16;           ///< chords that a piece is judged and bounded by
constexpr double kFlatness = 0.03;     ///< deviation from the chord as a share of its length
constexpr double kUneven = 0.1;        ///< sideways shift of the middle along the chord, as a share of its length
constexpr double kLongestPiece = 0.1;  ///< as a share of the face's size
constexpr double kShortestPiece = 1e-5;
constexpr int kMaxDepth = 16;
/// Second derivative of the squared distance along the curve, relative to a straight line's, below which there may be
/// several minima.
constexpr double kSoft = 0.35;
constexpr int kCreaseScan = 64;  ///< samples a knot span in which crossings of creases are looked for
/// Borders nearer than this share of the face's size are one and the same edge of the part.
constexpr double kSharedGap = 1e-5;

/// The octahedron around c that holds the ball of radius r: its faces lie at reach / sqrt(3) from c.
void append_ball(const Vec3& c, double r, std::vector<Vec3>& out) {
  const double reach = r * std::sqrt(3.0);
  for (int axis = 0; axis < 3; ++axis) {
    out.push_back(c + reach * Vec3::Unit(axis));
    out.push_back(c - reach * Vec3::Unit(axis));
  }
}

/// Appends where a coordinate of the curve crosses one of the levels between two parameters at which it has the given
/// values.
void append_crossings(const BSplineCurve2& curve, int axis, const std::vector<double>& levels, double t0, double x0,
                      double t1, double x1, std::vector<double>& out) {
  auto level = std::upper_bound(levels.begin(), levels.end(), std::min(x0, x1));
  for (; level != levels.end() && *level < std::max(x0, x1); ++level) {
    double low = t0, high = t1;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      ((curve.value(middle)[axis] < *level) == (x0 < *level) ? low : high) = middle;
    }
    out.push_back(0.5 * (low + high));
  }
}

}  // namespace

NurbsBorders::NurbsBorders(const std::vector<Face>& faces, const std::vector<NurbsFace>& prepared) {
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const int face = static_cast<int>(k), first = static_cast<int>(edges_.size());
    if (prepared[k].whole()) {
      const ParameterBox& d = prepared[k].domain();
      add_loop(rectangle_loop({d.u0, d.u1, d.v0, d.v1}), prepared, face);
      rectangle_edges_.push_back({first + 3, first + 1, first, first + 2});
    } else {
      for (const TrimLoop& loop : faces[k].loops) add_loop(loop, prepared, face);
      rectangle_edges_.push_back({-1, -1, -1, -1});
    }
  }
  find_partners(prepared);
}

/// Parameters at which the curve on the surface is not smooth: its own knots, and where it crosses creases of the face.
/// Between them it is, so that a piece may be searched by Newton's method.
std::vector<double> NurbsBorders::breaks(const NurbsFace& face, const BSplineCurve2& curve) const {
  std::vector<double> knots{curve.first()};
  for (double k : curve.knots)
    if (k > knots.back() && k <= curve.last()) knots.push_back(k);
  std::vector<double> result = knots;
  const std::vector<double> creases_u = face.creases_u(), creases_v = face.creases_v();
  if (!creases_u.empty() || !creases_v.empty())
    for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
      double t0 = knots[k];
      Vec2 c0 = curve.value(t0);
      for (int i = 1; i <= kCreaseScan; ++i) {
        const double t1 = knots[k] + (knots[k + 1] - knots[k]) * i / kCreaseScan;
        const Vec2 c1 = curve.value(t1);
        append_crossings(curve, 0, creases_u, t0, c0[0], t1, c1[0], result);
        append_crossings(curve, 1, creases_v, t0, c0[1], t1, c1[1], result);
        t0 = t1;
        c0 = c1;
      }
    }
  std::sort(result.begin(), result.end());
  const double range = curve.last() - curve.first();
  const auto same = [&](double a, double b) { return b - a < 1e-9 * range; };
  result.erase(std::unique(result.begin(), result.end(), same), result.end());
  if (result.size() < 2) return knots;
  result.back() = curve.last();
  return result;
}

/// Pieces of a loop, linked round: a footpoint at the end of one looks at the next.
void NurbsBorders::add_loop(const TrimLoop& loop, const std::vector<NurbsFace>& faces, int face) {
  const int first = static_cast<int>(pieces_.size());
  for (const BSplineCurve2& curve : loop.edges) {
    const int edge = static_cast<int>(edges_.size());
    edges_.push_back(curve);
    pieces_of_edge_.emplace_back();
    const std::vector<double> t = breaks(faces[static_cast<std::size_t>(face)], curve);
    for (std::size_t k = 0; k + 1 < t.size(); ++k) split(faces, face, edge, t[k], t[k + 1], 0);
  }
  const int last = static_cast<int>(pieces_.size()) - 1;
  for (int k = first; k <= last; ++k) {
    BorderPiece& piece = pieces_[static_cast<std::size_t>(k)];
    piece.previous = k > first ? k - 1 : last;
    piece.next = k < last ? k + 1 : first;
    pieces_of_edge_[static_cast<std::size_t>(piece.edge)].push_back(k);
  }
}

NurbsBorders::CurveJet3 NurbsBorders::jet(const NurbsFace& face, int edge, double t) const {
  const CurveJet<2> c = edges_[static_cast<std::size_t>(edge)].jet(t);
  CurveJet3 r;
  // Trims of real files stray from the surface's rectangle by a little: its polynomials go on there.
  r.u = c.p[0];
  r.v = c.p[1];
  const SurfaceJet s = face.jet_within(r.u, r.v);
  const double u1 = c.d1[0], v1 = c.d1[1];
  r.p = s.p;
  r.d1 = u1 * s.du + v1 * s.dv;
  r.d2 = u1 * u1 * s.duu + 2.0 * u1 * v1 * s.duv + v1 * v1 * s.dvv + c.d2[0] * s.du + c.d2[1] * s.dv;
  return r;
}

/// Halves until a piece is nearly straight and evenly run through: then the squared distance along it has one minimum
/// for points that are not far away, and Newton's method finds it from the middle.
void NurbsBorders::split(const std::vector<NurbsFace>& faces, int face, int edge, double t0, double t1, int depth) {
  const NurbsFace& prepared = faces[static_cast<std::size_t>(face)];
  std::array<Vec3, kSamples + 1> p;
  for (int k = 0; k <= kSamples; ++k)
    p[static_cast<std::size_t>(k)] = jet(prepared, edge, t0 + (t1 - t0) * k / kSamples).p;
  const Vec3 chord = p.back() - p.front();
  double length = 0.0, worst = 0.0, local = 0.0;
  for (std::size_t k = 1; k <= kSamples; ++k) {
    length += (p[k] - p[k - 1]).norm();
    const double along = chord.squaredNorm() > 0.0 ? (p[k] - p[0]).dot(chord) / chord.squaredNorm() : 0.0;
    worst = std::max(worst, (p[k] - p[0] - along * chord).norm());
    if (k % 2 == 1) local = std::max(local, (p[k] - 0.5 * (p[k - 1] + p[k + 1])).norm());
  }
  const Vec3 shift = p[kSamples / 2] - 0.5 * (p.front() + p.back());
  const bool bent =
      worst > kFlatness * length || shift.norm() > kUneven * length || length > kLongestPiece * prepared.size();
  if (bent && length > kShortestPiece * prepared.size() && depth < kMaxDepth) {
    const double middle = 0.5 * (t0 + t1);
    split(faces, face, edge, t0, middle, depth + 1);
    split(faces, face, edge, middle, t1, depth + 1);
    return;
  }
  BorderPiece piece;
  piece.face = face;
  piece.edge = edge;
  piece.t0 = t0;
  piece.t1 = t1;
  // Between neighbouring samples the curve deviates by about a quarter of `local`, the deviation over twice that
  // length.
  std::vector<Vec3> around, hull;
  around.reserve(6 * p.size());
  for (const Vec3& q : p) append_ball(q, local + 1e-12 * prepared.size(), around);
  // Trims of real parts come to hundreds of thousands of pieces: the corners of a box are all that is kept of each.
  hull.reserve(8);
  append_corners(bounding_box(around), hull);
  pieces_.push_back(piece);
  hulls_.push_back(std::move(hull));
}

Vec3 NurbsBorders::point(const std::vector<NurbsFace>& faces, int index, double share) const {
  const BorderPiece& p = piece(index);
  return jet(faces[static_cast<std::size_t>(p.face)], p.edge, p.t0 + share * (p.t1 - p.t0)).p;
}

/// From the middle, and from both ends as well if the descent met a place so soft that it may have missed a minimum.
BorderPoint NurbsBorders::closest(const std::vector<NurbsFace>& faces, int index, const Vec3& p) const {
  const BorderPiece& one = piece(index);
  const NurbsFace& face = faces[static_cast<std::size_t>(one.face)];
  double stiffness = 1.0;
  BorderPoint best = descend(face, index, p, 0.5 * (one.t0 + one.t1), stiffness);
  if (stiffness >= kSoft) return best;
  for (double t : {one.t0, one.t1}) {
    const BorderPoint other = descend(face, index, p, t, stiffness);
    if (other.squared < best.squared) best = other;
  }
  return best;
}

/// Minimum of the squared distance over a piece by Newton's method, or by Gauss-Newton's where that is not convex, with
/// halved steps if it goes uphill. `stiffness`: least second derivative on the way, over that of a straight line.
BorderPoint NurbsBorders::descend(const NurbsFace& face, int index, const Vec3& p, double t, double& stiffness) const {
  const BorderPiece& piece = pieces_[static_cast<std::size_t>(index)];
  const double range = piece.t1 - piece.t0;
  BorderPoint best;
  best.piece = index;
  bool last = false;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const CurveJet3 c = jet(face, piece.edge, t);
    const Vec3 r = c.p - p;
    const double squared = r.squaredNorm();
    if (iteration > 0 && squared > best.squared * (1.0 + 1e-13)) {
      t = 0.5 * (t + best.t);
      if (std::abs(t - best.t) < 1e-14 * range) break;
      last = false;
      continue;
    }
    best.t = t;
    best.u = c.u;
    best.v = c.v;
    best.point = c.p;
    best.squared = squared;
    if (last) break;
    const double gradient = c.d1.dot(r), metric = c.d1.squaredNorm(), hessian = metric + c.d2.dot(r);
    if (!(metric > 0.0)) break;
    stiffness = std::min(stiffness, hessian / metric);
    const bool newton = hessian > 1e-6 * metric;
    const double next = std::clamp(t - gradient / (newton ? hessian : metric), piece.t0, piece.t1);
    const double step = std::abs(next - t) * std::sqrt(metric);
    if (next == t) break;
    last = step < (newton ? 1e-8 * std::min(1.0, hessian / metric) : 1e-13) * face.size();
    t = next;
  }
  return best;
}

int NurbsBorders::piece_at(const NurbsFace& face, int face_index, int border, double u, double v) const {
  const int edge = rectangle_edges_[static_cast<std::size_t>(face_index)][static_cast<std::size_t>(border)];
  const ParameterBox& d = face.domain();
  // The rectangle's loop runs u0 -> u1 along v0, then round.
  double t = 0.0;
  if (border == 0) t = (d.v1 - v) / (d.v1 - d.v0);
  if (border == 1) t = (v - d.v0) / (d.v1 - d.v0);
  if (border == 2) t = (u - d.u0) / (d.u1 - d.u0);
  if (border == 3) t = (d.u1 - u) / (d.u1 - d.u0);
  const std::vector<int>& list = pieces_of_edge_[static_cast<std::size_t>(edge)];
  const auto it = std::partition_point(list.begin(), list.end() - 1, [&](int k) { return piece(k).t1 < t; });
  return *it;
}

/// Finds pieces that lie on another edge, of a neighbouring face or the other side of a seam: there the target goes on.
/// Asked at three places inside the piece, since its ends may touch edges that only meet it.
void NurbsBorders::find_partners(const std::vector<NurbsFace>& faces) {
  const BoxTree tree(hulls_);
  for (BorderPiece& piece : pieces_) {
    const NurbsFace& face = faces[static_cast<std::size_t>(piece.face)];
    const double gap = kSharedGap * face.size();
    const Vec3 start = jet(face, piece.edge, piece.t0).p, end = jet(face, piece.edge, piece.t1).p;
    const auto probe = [&](double share, int& partner) {
      const Vec3 p = jet(face, piece.edge, piece.t0 + share * (piece.t1 - piece.t0)).p;
      double best = gap * gap;
      partner = -1;
      tree.nearest(p, best, [&](int other) {
        if (pieces_[static_cast<std::size_t>(other)].edge == piece.edge) return;
        const BorderPoint found = closest(faces, other, p);
        if (found.squared >= best) return;
        best = found.squared;
        partner = other;
      });
      return partner >= 0;
    };
    if ((start - end).norm() <= gap && (start - jet(face, piece.edge, 0.5 * (piece.t0 + piece.t1)).p).norm() <= gap) {
      piece.interior = face.closed_u() || face.closed_v();  // a pole
      continue;
    }
    int partner = -1;
    piece.interior = probe(0.2, partner) && probe(0.8, partner) && probe(0.5, partner);
    piece.partner = piece.interior ? partner : -1;
  }
}

}  // namespace flank::internal
