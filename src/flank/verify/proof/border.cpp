#include "flank/verify/proof/border.h"

#include "flank/geom/trim.h"

#include <algorithm>
#include <cmath>

namespace flank::internal::verify {
namespace {

constexpr int kMostHalvings = 14;  ///< of a knot span; what is not flat by then stays with a wider chord
constexpr int kMostRows = 1024;
constexpr double kChordsPerRow = 2.0;

}  // namespace

std::vector<double> distinct_knots(const std::vector<double>& knots, double first, double last) {
  std::vector<double> out;
  for (double k : knots)
    if (k >= first && k <= last && (out.empty() || k > out.back())) out.push_back(k);
  return out;
}

std::vector<BSplineCurve2> border_curves(const Face& face) {
  std::vector<BSplineCurve2> curves;
  for (const TrimLoop& loop : face.loops) {
    const std::size_t start = curves.size();
    const auto close = [&](const Vec2& from, const Vec2& to) {
      if ((from.array() != to.array()).any()) curves.push_back(straight_edge(from, to));
    };
    for (const BSplineCurve2& edge : loop.edges) {
      if (curves.size() > start) close(curves.back().value(curves.back().last()), edge.value(edge.first()));
      curves.push_back(edge);
    }
    if (curves.size() > start)
      close(curves.back().value(curves.back().last()), curves[start].value(curves[start].first()));
  }
  return curves;
}

std::vector<double> kinks(const std::vector<double>& knots, int degree, double first, double last) {
  std::vector<double> out;
  for (double k : distinct_knots(knots, first, last))
    if (k > first && k < last && std::count(knots.begin(), knots.end(), k) >= degree) out.push_back(k);
  return out;
}

Border::Border(const std::vector<BSplineCurve2>& curves, const Vec2& tolerance) : tolerance_(tolerance) {
  for (const BSplineCurve2& curve : curves) {
    const std::vector<double> knots = distinct_knots(curve.knots, curve.first(), curve.last());
    for (std::size_t k = 0; k + 1 < knots.size(); ++k) add(curve, knots[k], knots[k + 1], 0);
  }
  for (const Chord& c : chords_) {
    box_.low = box_.low.cwiseMin(c.a.cwiseMin(c.b));
    box_.high = box_.high.cwiseMax(c.a.cwiseMax(c.b));
  }
  rows_.resize(std::clamp(static_cast<std::size_t>(static_cast<double>(chords_.size()) / kChordsPerRow), std::size_t{1},
                          std::size_t{kMostRows}));
  for (std::size_t k = 0; k < chords_.size(); ++k) {
    const auto [low, high] = std::minmax(chords_[k].a.y(), chords_[k].b.y());
    for (int r = row(low - tolerance_.y()); r <= row(high + tolerance_.y()); ++r)
      rows_[static_cast<std::size_t>(r)].push_back(static_cast<int>(k));
  }
}

// A curve leaves its chord by at most an eighth of its largest second derivative.
void Border::add(const BSplineCurve2& curve, double low, double high, int depth) {
  const Vec2 off = 0.125 * curve_bounds(curve, low, high).d2;
  if (!(off.array() <= tolerance_.array()).all() && depth < kMostHalvings) {
    const double middle = 0.5 * (low + high);
    add(curve, low, middle, depth + 1);
    add(curve, middle, high, depth + 1);
    return;
  }
  tolerance_ = tolerance_.cwiseMax(off);
  chords_.push_back({curve.value(low), curve.value(high)});
}

int Border::row(double v) const {
  const double share = (v - box_.low.y()) / std::max(box_.high.y() - box_.low.y(), 1e-300);
  const int count = static_cast<int>(rows_.size());
  return static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * (count - 1)));
}

bool Border::meets(const Chord& c, const Rectangle& where) const {
  const Vec2 low = where.low - tolerance_, high = where.high + tolerance_;
  if ((c.a.cwiseMax(c.b).array() < low.array()).any() || (c.a.cwiseMin(c.b).array() > high.array()).any()) return false;
  // The line through the chord must pass between the rectangle's corners.
  const Vec2 d = c.b - c.a, half = 0.5 * (high - low), to = 0.5 * (low + high) - c.a;
  const double across = d.x() * to.y() - d.y() * to.x();
  return std::abs(across) <= (std::abs(d.x()) * half.y() + std::abs(d.y()) * half.x()) * (1.0 + 1e-9);
}

Side Border::side(const Rectangle& where) const {
  for (int r = row(where.low.y() - tolerance_.y()); r <= row(where.high.y() + tolerance_.y()); ++r)
    for (int k : rows_[static_cast<std::size_t>(r)])
      if (meets(chords_[static_cast<std::size_t>(k)], where)) return Side::kAcross;
  return inside(where.middle()) ? Side::kInside : Side::kOutside;
}

bool Border::inside(const Vec2& p) const {
  if (p.y() < box_.low.y() || p.y() > box_.high.y()) return false;
  int left = 0;
  for (int k : rows_[static_cast<std::size_t>(row(p.y()))]) {
    const Chord& c = chords_[static_cast<std::size_t>(k)];
    if ((c.a.y() <= p.y()) == (c.b.y() <= p.y())) continue;
    left += c.a.x() + (p.y() - c.a.y()) / (c.b.y() - c.a.y()) * (c.b.x() - c.a.x()) <= p.x();
  }
  return left % 2 == 1;
}

}  // namespace flank::internal::verify
