#include "flank/verify/proof/face_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flank/geom/trim.h"
#include "flank/verify/proof/border.h"
#include "flank/verify/proof/patch_bounds.h"

namespace flank::internal::verify {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kBorderShare = 1e-5;  ///< of the parameter range: how near the chords of the border keep to it
constexpr double kLongShare = 2.0;     ///< a cell so much longer than wide is cut across only
constexpr int kMostPieces = 64;        ///< knot rectangles that a cell may hold and still be bounded by all of them

enum Kind { kPatch, kCurve, kCorner };

class FaceShape final : public Shape {
 public:
  explicit FaceShape(const Face& face) : s_(face.surface), curves_(border_curves(face)), trimmed_(!curves_.empty()) {
    domain_ = {{s_.u_first(), s_.v_first()}, {s_.u_last(), s_.v_last()}};
    border_ = std::make_unique<Border>(curves_, kBorderShare * (domain_.high - domain_.low));
    if (trimmed_) {
      domain_.low = domain_.low.cwiseMax(border_->box().low);
      domain_.high = domain_.high.cwiseMin(border_->box().high);
    } else {
      add_frame(domain_);
    }
    borders_ = curves_.size();
    knots_u_ = distinct_knots(s_.knots_u, s_.u_first(), s_.u_last());
    knots_v_ = distinct_knots(s_.knots_v, s_.v_first(), s_.v_last());
    kinks_u_ = kinks(s_.knots_u, s_.degree_u, s_.u_first(), s_.u_last());
    kinks_v_ = kinks(s_.knots_v, s_.degree_v, s_.v_first(), s_.v_last());
    for (double u : kinks_u_) curves_.push_back(straight_edge({u, domain_.low.y()}, {u, domain_.high.y()}));
    for (double v : kinks_v_) curves_.push_back(straight_edge({domain_.low.x(), v}, {domain_.high.x(), v}));
  }

  [[nodiscard]] std::vector<Cell> first() const override {
    std::vector<Cell> cells;
    const auto add = [&](int kind, int index, std::array<double, 4> at) {
      Cell cell;
      cell.kind = kind;
      cell.index = index;
      cell.at = at;
      cell.inside = kind == kPatch ? !trimmed_ : index < static_cast<int>(borders_);
      cells.push_back(cell);
    };
    if ((domain_.low.array() <= domain_.high.array()).all())
      add(kPatch, 0, {domain_.low.x(), domain_.high.x(), domain_.low.y(), domain_.high.y()});
    for (std::size_t k = 0; k < curves_.size(); ++k) {
      const std::vector<double> knots = distinct_knots(curves_[k].knots, curves_[k].first(), curves_[k].last());
      for (std::size_t i = 0; i < knots.size(); ++i) {
        add(kCorner, static_cast<int>(k), {knots[i], knots[i], 0.0, 0.0});
        if (i + 1 < knots.size()) add(kCurve, static_cast<int>(k), {knots[i], knots[i + 1], 0.0, 0.0});
      }
    }
    return cells;
  }

  [[nodiscard]] Probe look(Cell& cell) const override {
    if (cell.kind == kPatch) return look_at_patch(cell);
    return cell.kind == kCurve ? look_at_curve(cell) : look_at_corner(cell);
  }

  void split(const Cell& cell, std::vector<Cell>& parts) const override {
    const auto half = [](const Cell& whole, std::size_t k, double at, Cell& low, Cell& high) {
      low = high = whole;
      low.at[k + 1] = high.at[k] = at;
    };
    Cell a, b;
    if (cell.kind == kCurve) {
      half(cell, 0, 0.5 * (cell.at[0] + cell.at[1]), a, b);
      parts.push_back(a);
      parts.push_back(b);
      return;
    }
    const double at_u = cut(knots_u_, cell.at[0], cell.at[1]), at_v = cut(knots_v_, cell.at[2], cell.at[3]);
    const bool u = cell.stretch_u * kLongShare >= cell.stretch_v, v = cell.stretch_v * kLongShare >= cell.stretch_u;
    if (u && v) {
      Cell left, right;
      half(cell, 0, at_u, left, right);
      for (const Cell& side : {left, right}) {
        half(side, 2, at_v, a, b);
        parts.push_back(a);
        parts.push_back(b);
      }
      return;
    }
    half(cell, u ? 0 : 2, u ? at_u : at_v, a, b);
    parts.push_back(a);
    parts.push_back(b);
  }

  [[nodiscard]] Cell cell_of(const std::array<double, 4>& sample) const override {
    Cell cell;
    cell.kind = kPatch;
    cell.at = sample;
    cell.inside = !trimmed_;
    return cell;
  }

  [[nodiscard]] bool hull(const Cell& cell, std::vector<Vec3>& points) const override {
    points.clear();
    return in_pieces(where_of(cell), [&](const Rectangle& piece) { return add_control_points(s_, piece, points); });
  }

  [[nodiscard]] double area_bound(const Cell& cell) const override {
    double sum = 0.0;
    const bool all = in_pieces(where_of(cell), [&](const Rectangle& piece) {
      sum += piece_area_bound(piece);
      return true;
    });
    return all ? sum : kInfinite;
  }

 private:
  static Rectangle where_of(const Cell& cell) { return {{cell.at[0], cell.at[2]}, {cell.at[1], cell.at[3]}}; }

  void add_frame(const Rectangle& r) {
    const std::array<Vec2, 4> corners{r.low, Vec2(r.high.x(), r.low.y()), r.high, Vec2(r.low.x(), r.high.y())};
    for (std::size_t k = 0; k < 4; ++k) curves_.push_back(straight_edge(corners[k], corners[(k + 1) % 4]));
  }

  // |S_u x S_v| in the middle, and half of the largest derivative of that product besides.
  [[nodiscard]] double piece_area_bound(const Rectangle& where) const {
    const PatchBounds b = patch_bounds(s_, where);
    const SurfaceJet jet = s_.jet(where.middle().x(), where.middle().y());
    const Vec2 size = where.high - where.low;
    const double middle = size.x() * size.y() * jet.du.cross(jet.dv).norm();
    const double more = b.duu * b.dv + b.du * b.duv + b.duv * b.dv + b.du * b.dvv;
    return std::min(b.du * b.dv, middle + 0.5 * more);
  }

  /// Calls `use` with the parts of a rectangle between knots until one is refused; false then, or where there are too many. Lofts
  /// through many sections have hundreds of knots, several in each cell.
  template <class Use>
  [[nodiscard]] bool in_pieces(const Rectangle& where, const Use& use) const {
    if (one_piece(s_, where)) return use(where);
    const std::vector<double> us = pieces(knots_u_, where.low.x(), where.high.x());
    const std::vector<double> vs = pieces(knots_v_, where.low.y(), where.high.y());
    if ((us.size() - 1) * (vs.size() - 1) > kMostPieces) return false;
    for (std::size_t i = 0; i + 1 < us.size(); ++i)
      for (std::size_t j = 0; j + 1 < vs.size(); ++j)
        if (!use(Rectangle{{us[i], vs[j]}, {us[i + 1], vs[j + 1]}})) return false;
    return true;
  }

  /// An interval's ends and the knots inside.
  static std::vector<double> pieces(const std::vector<double>& knots, double low, double high) {
    std::vector<double> at{low};
    for (auto k = std::upper_bound(knots.begin(), knots.end(), low); k != knots.end() && *k < high; ++k)
      at.push_back(*k);
    at.push_back(high);
    return at;
  }

  /// The knot nearest to the middle of an interval, or the middle if there is none inside.
  static double cut(const std::vector<double>& knots, double low, double high) {
    const double middle = 0.5 * (low + high);
    double best = middle, nearest = 1e300;
    for (auto k = std::upper_bound(knots.begin(), knots.end(), low); k != knots.end() && *k < high; ++k)
      if (std::abs(*k - middle) < nearest) nearest = std::abs(*k - middle), best = *k;
    return best;
  }

  [[nodiscard]] bool holds(const Vec2& place) const { return !trimmed_ || border_->inside(place); }

  [[nodiscard]] Probe look_at_patch(Cell& cell) const {
    const Rectangle where = where_of(cell);
    if (!cell.inside) {
      const Side side = border_->side(where);
      if (side == Side::kOutside) return {.empty = true};
      cell.inside = side == Side::kInside;
    }
    if (!one_piece(s_, where)) {
      const PatchBounds b = loose_bounds(s_, where);
      // Cut where there are knots, in both directions if there are in both.
      cell.stretch_u = has_knot(knots_u_, where.low.x(), where.high.x()) ? 1.0F : 0.0F;
      cell.stretch_v = has_knot(knots_v_, where.low.y(), where.high.y()) ? 1.0F : 0.0F;
      return {.point = b.middle, .reach = b.reach, .bend = kInfinite};
    }
    const PatchBounds b = patch_bounds(s_, where);
    cell.stretch_u = static_cast<float>(b.du);
    cell.stretch_v = static_cast<float>(b.dv);
    return {.on_face = cell.inside || holds(where.middle()), .point = b.middle, .reach = b.reach, .bend = b.bend()};
  }

  static bool has_knot(const std::vector<double>& knots, double low, double high) {
    const auto k = std::upper_bound(knots.begin(), knots.end(), low);
    return k != knots.end() && *k < high;
  }

  /// Largest derivatives, by the parameters themselves, over the rectangle; infinite bends if a kink is inside.
  [[nodiscard]] PatchBounds largest(const Rectangle& where) const {
    PatchBounds out;
    const bool all = in_pieces(where, [&](const Rectangle& piece) {
      const PatchBounds b = patch_bounds(s_, piece);
      const Vec2 by = (piece.high - piece.low).cwiseInverse();
      out.du = std::max(out.du, b.du * by.x());
      out.dv = std::max(out.dv, b.dv * by.y());
      out.duu = std::max(out.duu, b.duu * by.x() * by.x());
      out.duv = std::max(out.duv, b.duv * by.x() * by.y());
      out.dvv = std::max(out.dvv, b.dvv * by.y() * by.y());
      return true;
    });
    if (!all) {
      out.du = out.dv = out.duu = out.duv = out.dvv = kInfinite;
      return out;
    }
    // A curve along a kink does not cross it: its derivative in the other direction is 0.
    if (has_knot(kinks_u_, where.low.x(), where.high.x())) out.duu = kInfinite;
    if (has_knot(kinks_v_, where.low.y(), where.high.y())) out.dvv = kInfinite;
    return out;
  }

  // X(t) = S(c(t)): X' = S_u u' + S_v v', X'' = S_uu u'^2 + 2 S_uv u' v' + S_vv v'^2 + S_u u'' + S_v v''.
  [[nodiscard]] Probe look_at_curve(Cell& cell) const {
    const BSplineCurve2& curve = curves_[static_cast<std::size_t>(cell.index)];
    CurveBounds c = curve_bounds(curve, cell.at[0], cell.at[1]);
    if (!cell.inside && trimmed_ && border_->side(c.box) == Side::kOutside) return {.empty = true};
    const Vec2 middle = curve.value(0.5 * (cell.at[0] + cell.at[1]));
    // Straight along an iso-line, the box has no width: it gets as much as derivatives by that parameter need.
    const Vec2 least = 1e-3 * (c.box.high - c.box.low).maxCoeff() * Vec2::Ones() + 1e-9 * (domain_.high - domain_.low);
    const Vec2 wide = (least - (c.box.high - c.box.low)).cwiseMax(0.0);
    Rectangle box{c.box.low - 0.5 * wide, c.box.high + 0.5 * wide};
    // Not beyond the domain of the surface, unless the curve itself is there.
    box.low = box.low.cwiseMax(Vec2(s_.u_first(), s_.v_first()).cwiseMin(c.box.low));
    box.high = box.high.cwiseMin(Vec2(s_.u_last(), s_.v_last()).cwiseMax(c.box.high));
    const PatchBounds b = largest(box);
    const auto times = [](double length, double by) { return by > 0.0 ? length * by : 0.0; };
    const double speed = times(b.du, c.d1.x()) + times(b.dv, c.d1.y());
    const double second = times(b.duu, c.d1.x() * c.d1.x()) + 2.0 * times(b.duv, c.d1.x() * c.d1.y()) +
                          times(b.dvv, c.d1.y() * c.d1.y()) + times(b.du, c.d2.x()) + times(b.dv, c.d2.y());
    Probe probe{.on_face = cell.inside || holds(middle), .point = s_.value(middle.x(), middle.y())};
    probe.reach = 0.5 * speed;
    if (!(probe.reach < 1e300)) {
      const PatchBounds loose = loose_bounds(s_, c.box);
      probe.reach = loose.reach + (probe.point - loose.middle).norm();
    }
    probe.bend = 0.125 * second;
    return probe;
  }

  [[nodiscard]] Probe look_at_corner(const Cell& cell) const {
    const Vec2 at = curves_[static_cast<std::size_t>(cell.index)].value(cell.at[0]);
    if (!cell.inside && !holds(at)) return {.empty = true};
    return {.on_face = true, .point = s_.value(at.x(), at.y())};
  }

  const BSplineSurface& s_;
  Rectangle domain_;
  std::vector<BSplineCurve2> curves_;  ///< the border, then the kinks
  bool trimmed_;
  std::size_t borders_ = 0;  ///< how many of them are the border
  std::unique_ptr<Border> border_;
  std::vector<double> knots_u_, knots_v_, kinks_u_, kinks_v_;
};

}  // namespace

std::unique_ptr<Shape> make_shape(const Face& face) { return std::make_unique<FaceShape>(face); }

}  // namespace flank::internal::verify
