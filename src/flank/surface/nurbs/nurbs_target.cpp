#include "flank/surface/nurbs/nurbs_target.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flank/base/assert.h"
#include "flank/error.h"
#include "flank/surface/nurbs/nurbs_samples.h"

namespace flank::internal {
namespace {

/// Sideways part of p - point, as a share of the face's size, below which the point is a footpoint and not held by a
/// border.
constexpr double kAlongNormal = 1e-9;
/// A warm footpoint on an extension gives way to a neighbouring face's point that is nearer to it than this share of
/// the face's size.
constexpr double kHandOver = 0.15;
/// Of the face's size: more than a border piece is off by (nurbs_face has borders this near for one), and nothing beside
/// a distance that counts.
constexpr double kBehindBorder = 1e-7;
/// A minimum softer than this may have another one beside it; then the cell is searched from kFocalStarts x
/// kFocalStarts points.
constexpr double kSoft = 0.35;
constexpr int kFocalStarts = 3;
/// Points in each direction that tell the box of a cell cut by a trim.
constexpr int kCutGrid = 16;
/// Cut cells are quartered down to this share of the face's size, and at most so often, to find their areas.
constexpr double kAreaGrain = 3e-3;
constexpr int kAreaDepth = 6;

}  // namespace

struct NurbsTarget::Best {
  double squared = std::numeric_limits<double>::infinity();
  int face = -1, piece = -1;  ///< piece >= 0: on the border of a trimmed face
  double u = 0.0, v = 0.0, t = 0.0;
};

/// What no search can be built on.
void NurbsTarget::check(const Face& face) {
  const BSplineSurface& s = face.surface;
  const auto refuse = [&](const std::string& why) { throw InputError("face " + face.id + ": " + why); };
  if (s.degree_u < 1 || s.degree_v < 1 || s.degree_u > kMaxDegree || s.degree_v > kMaxDegree)
    refuse("expected degrees from 1 to " + std::to_string(kMaxDegree));
  if (!std::all_of(s.poles.begin(), s.poles.end(), [](const Vec3& p) { return p.allFinite(); }))
    refuse("its control points must be finite");
  if (!std::all_of(s.weights.begin(), s.weights.end(), [](double w) { return std::isfinite(w) && w > 0.0; }))
    refuse("its weights must be positive");
  if (!(s.u_first() < s.u_last() && s.v_first() < s.v_last())) refuse("its knots must span an interval");
  Box3 box;
  for (const Vec3& p : s.poles) box.add(p);
  if (!(box.diagonal() > 0.0)) refuse("all its control points are the same point");
}

NurbsTarget::NurbsTarget(const std::vector<Face>& faces, int side, const ExtensionOptions& options) {
  FLANK_ASSERT(side == 1 || side == -1);
  if (faces.empty()) throw InputError("a target needs at least one face");
  FlatCells cells;
  for (const Face& one : faces) {
    check(one);
    faces_.emplace_back(one, side, options);
    append_flat_cells(faces_.back(), static_cast<int>(faces_.size()) - 1, cells);
  }
  if (cells.cells.empty()) throw InputError("face " + faces.front().id + ": its trims leave nothing of the surface");
  borders_ = NurbsBorders(faces, faces_);
  std::vector<std::vector<Vec3>> hulls = borders_.take_hulls();
  has_neighbour_.assign(faces.size(), false);
  for (std::size_t k = 0; k < borders_.pieces().size(); ++k) {
    const BorderPiece& piece = borders_.pieces()[k];
    if (piece.partner >= 0 && borders_.piece(piece.partner).face != piece.face)
      has_neighbour_[static_cast<std::size_t>(piece.face)] = true;
    if (face(piece.face).whole()) continue;
    searched_pieces_.push_back(static_cast<int>(k));
    cells.hulls.push_back(std::move(hulls[k]));
  }
  tree_ = BoxTree(cells.hulls);
  cells_ = std::move(cells.cells);
  measure();
}

/// Area and box. A cell on the trim is quartered until a piece is a small share of the face: an area error of the
/// second order.
void NurbsTarget::measure_cell(const FlatCell& cell) {
  const NurbsFace& f = face(cell.face);
  const double width = cell.u1 - cell.u0, height = cell.v1 - cell.v0;
  const SurfaceJet middle = f.jet_within(cell.u0 + 0.5 * width, cell.v0 + 0.5 * height);
  const double edge = std::sqrt(middle.du.cross(middle.dv).norm() * width * height);
  const double halvings = cell.cut ? std::ceil(std::log2(std::max(1.0, edge / (kAreaGrain * f.size())))) : 0.0;
  area_ += trimmed_area(f, {cell.u0, cell.u1, cell.v0, cell.v1}, std::min(static_cast<int>(halvings), kAreaDepth));
  const int grid = cell.cut ? kCutGrid : 4;
  for (int i = 0; i <= grid; ++i)
    for (int j = 0; j <= grid; ++j) {
      const double u = cell.u0 + width * i / grid, v = cell.v0 + height * j / grid;
      if (!cell.cut || f.inside(u, v)) box_.add(f.jet_within(u, v).p);
    }
}

void NurbsTarget::measure() {
  for (const FlatCell& cell : cells_) measure_cell(cell);
  for (int k : searched_pieces_)
    for (double share : {0.0, 0.25, 0.5, 0.75, 1.0}) box_.add(borders_.point(faces_, k, share));
}

/// One descent from a start in the cell. It may leave the cell for as far as `reach`; once something was found, it is
/// given up as soon as it is held outside the zone in which this cell can win.
Descent NurbsTarget::descend_cell(const FlatCell& cell, const Vec3& p, double u, double v, Best& best) const {
  const NurbsFace& f = face(cell.face);
  Descent x;
  x.u = u;
  x.v = v;
  descend(f.patches(), p, cell.reach, f.size(), best.face < 0 ? nullptr : &cell.zone, x);
  if (x.squared >= best.squared) return x;
  double squared = x.squared;
  if (!f.whole()) {
    // In the interior of the trims a closest point is stationary or on a crease; on the trims the border's own pieces
    // find it.
    const bool own = !cell.cut && x.u >= cell.u0 && x.u <= cell.u1 && x.v >= cell.v0 && x.v <= cell.v1;
    const ParameterBox& d = f.domain();
    const bool at_rectangle = (x.side_u < 0 && x.u <= d.u0) || (x.side_u > 0 && x.u >= d.u1) ||
                              (x.side_v < 0 && x.v <= d.v0) || (x.side_v > 0 && x.v >= d.v1);
    const bool settled = x.end == Descent::End::kConverged && !at_rectangle;
    if (!own && !(settled && f.inside(x.u, x.v))) return x;
    // A trim along the rectangle is its border: the piece that lies there goes before the cell, which knows no border.
    if (at_rectangle) squared = std::pow(std::sqrt(squared) + kBehindBorder * f.size(), 2);
    if (squared >= best.squared) return x;
  }
  best = {squared, cell.face, -1, x.u, x.v, 0.0};
  return x;
}

/// The start is the foot of p on the cell's tangent plane. Several minima are possible only beyond the focal distance,
/// so only there, or where the first descent met a soft place, is the cell searched from a grid. Nearer than that a descent that is
/// held by a border has the only one, too: most queries of a fit are such, and find nothing within their horizon.
void NurbsTarget::search_cell(const FlatCell& cell, const Vec3& p, Best& best) const {
  const Vec3 r = p - cell.center;
  const double du = cell.u1 - cell.u0, dv = cell.v1 - cell.v0;
  const double u = std::clamp(cell.u0 + 0.5 * du + r.dot(cell.to_u), cell.u0, cell.u1);
  const double v = std::clamp(cell.v0 + 0.5 * dv + r.dot(cell.to_v), cell.v0, cell.v1);
  const Descent x = descend_cell(cell, p, u, v, best);
  const bool settled = x.end != Descent::End::kAbandoned;
  int starts = 0;
  if ((settled && x.stiffness < kSoft) || can_be_focal(cell, r))
    starts = kFocalStarts;  // minima may lie close together: roll down from all over the cell
  else if (settled && (x.side_u != 0 || x.side_v != 0) && !is_convex(cell, r))
    starts = 2;  // held by a border or crease: another side of the cell may hold a better one
  for (int k = 0; k < starts * starts; ++k)
    (void)descend_cell(cell, p, cell.u0 + (k / starts) * du / (starts - 1), cell.v0 + (k % starts) * dv / (starts - 1),
                       best);
}

void NurbsTarget::search_border(int piece, const Vec3& p, Best& best) const {
  const BorderPoint x = borders_.closest(faces_, piece, p);
  if (x.squared < best.squared) best = {x.squared, borders_.piece(piece).face, piece, x.u, x.v, x.t};
}

Footpoint NurbsTarget::closest_within(const Vec3& p, double horizon_mm) const {
  Best best;
  best.squared = std::min(best.squared, horizon_mm * horizon_mm);
  // A point that is not finite is near nothing.
  if (!p.allFinite()) return finish(p, best);
  tree_.nearest(p, best.squared, [&](int item) {
    const auto k = static_cast<std::size_t>(item);
    if (k < cells_.size())
      search_cell(cells_[k], p, best);
    else
      search_border(searched_pieces_[k - cells_.size()], p, best);
  });
  return finish(p, best);
}

/// Whether the target goes on past all border pieces that meet at this place: then the place is no border of it.
/// `partner`: the piece on the other side, if there is one.
bool NurbsTarget::leads_on(const Best& best, int& partner) const {
  const NurbsFace& f = face(best.face);
  int count = 0;
  std::array<int, 4> pieces{};
  if (best.piece >= 0) {
    const BorderPiece& piece = borders_.piece(best.piece);
    pieces[static_cast<std::size_t>(count++)] = best.piece;
    if (best.t <= piece.t0) pieces[static_cast<std::size_t>(count++)] = piece.previous;
    if (best.t >= piece.t1) pieces[static_cast<std::size_t>(count++)] = piece.next;
  } else if (f.whole()) {
    const ParameterBox& d = f.domain();
    const std::array<bool, 4> on{best.u <= d.u0, best.u >= d.u1, best.v <= d.v0, best.v >= d.v1};
    for (int border = 0; border < 4; ++border)
      if (on[static_cast<std::size_t>(border)])
        pieces[static_cast<std::size_t>(count++)] = borders_.piece_at(f, best.face, border, best.u, best.v);
  }
  bool all = true;
  for (int k = 0; k < count; ++k) {
    const BorderPiece& piece = borders_.piece(pieces[static_cast<std::size_t>(k)]);
    all = all && piece.interior;
    if (piece.partner >= 0) partner = piece.partner;
  }
  return all;
}

/// The footpoint of the best place. p - point may be off the normal for two reasons: a real border, or a sharp edge
/// inside the target, which counts as inside and needs a sign of its own.
Footpoint NurbsTarget::finish(const Vec3& p, const Best& best) const {
  if (best.face < 0) {  // nothing within the horizon, or p is not finite
    Footpoint nothing;
    nothing.distance = std::numeric_limits<double>::quiet_NaN();
    return nothing;
  }
  const NurbsFace& f = face(best.face);
  const SurfaceJet jet = f.jet_within(best.u, best.v);
  Vec3 n = f.normal(jet, best.u, best.v);
  const Vec3 r = p - jet.p;
  const bool along = (r - r.dot(n) * n).norm() <= kAlongNormal * std::max(f.size(), r.norm());
  Location location = Location::kInside;
  Footpoint result;
  if (!along) {
    int partner = -1;
    if (!leads_on(best, partner)) location = Location::kBorder;
    result = f.footpoint(p, best.u, best.v, jet, false, location);
    if (location == Location::kInside && partner >= 0) {
      // A sharp edge between two faces: the mean of both normals tells the side (Baerentzen and Aanaes 2005).
      const BorderPoint other = borders_.closest(faces_, partner, jet.p);
      const NurbsFace& g = face(borders_.piece(partner).face);
      n += g.normal(g.jet_within(other.u, other.v), other.u, other.v);
      if ((r.dot(n) < 0.0) != (result.distance < 0.0)) {
        result.distance = -result.distance;
        result.normal = -result.normal;
      }
    }
  } else {
    result = f.footpoint(p, best.u, best.v, jet, true, location);
  }
  result.patch = best.face;
  return result;
}

Footpoint NurbsTarget::track(const Vec3& p, const Footpoint& hint) const {
  bool ok = false;
  if (hint.patch >= 0 && hint.patch < patch_count() && p.allFinite()) {
    Footpoint f = face(hint.patch).track(p, hint.u, hint.v, ok);
    f.patch = hint.patch;
    if (ok && (f.location == Location::kInside || !has_neighbour_[static_cast<std::size_t>(hint.patch)])) return f;
    if (ok) {  // past a border that may be shared: the neighbour takes over where it is near
      const Footpoint cold = closest(p);
      const double near = kHandOver * face(hint.patch).size();
      return cold.location == Location::kInside && (cold.point - f.point).norm() < near ? cold : f;
    }
  }
  const Footpoint cold = closest(p);
  if (cold.location != Location::kBorder) return cold;
  Footpoint f = face(cold.patch).track(p, cold.u, cold.v, ok);
  f.patch = cold.patch;
  return ok ? f : cold;
}

std::vector<SurfaceSample> NurbsTarget::samples(double spacing_mm) const {
  FLANK_ASSERT(spacing_mm > 0.0);
  std::vector<SurfaceSample> result;
  for (std::size_t k = 0; k < faces_.size(); ++k) append_samples(faces_[k], static_cast<int>(k), spacing_mm, result);
  return result;
}

std::vector<Vec3> NurbsTarget::border_points(double spacing_mm) const {
  FLANK_ASSERT(spacing_mm > 0.0);
  std::vector<Vec3> points;
  const auto& pieces = borders_.pieces();
  for (int k = 0; k < static_cast<int>(pieces.size()); ++k) {
    if (borders_.piece(k).interior) continue;
    const double chord = (borders_.point(faces_, k, 1.0) - borders_.point(faces_, k, 0.0)).norm();
    const int steps = std::max(1, static_cast<int>(std::ceil(chord / spacing_mm)));
    for (int i = 0; i < steps; ++i) points.push_back(borders_.point(faces_, k, static_cast<double>(i) / steps));
  }
  return points;
}

}  // namespace flank::internal

namespace flank {
using namespace internal;

std::unique_ptr<Target> make_target(std::vector<Face> faces, int side, const ExtensionOptions& options) {
  return std::make_unique<NurbsTarget>(faces, side, options);
}

}  // namespace flank
