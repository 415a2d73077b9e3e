#include "flank/verify/trim.h"

#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"

namespace flank::internal::verify {
namespace {

constexpr int kPiecesPerSpan = 4;  ///< first cut of each knot span, so that no bend hides between samples
constexpr int kMaxDepth = 12;      ///< of halvings: 4096 pieces of each, where a file's curve has a kink or a fold

}  // namespace

Trim::Trim(const std::vector<TrimLoop>& loops, double tolerance_u, double tolerance_v) : everything_(loops.empty()) {
  FLANK_ASSERT(tolerance_u > 0.0 && tolerance_v > 0.0);
  for (const TrimLoop& loop : loops) {
    const std::size_t start = chords_.size();
    for (const BSplineCurve2& edge : loop.edges) {
      // Edges of a file meet within a tolerance only: a chord joins them.
      if (chords_.size() > start) close(chords_.back().b, edge.value(edge.first()));
      add(edge, tolerance_u, tolerance_v);
    }
    if (chords_.size() > start) close(chords_.back().b, chords_[start].a);
  }
  for (const Chord& c : chords_) {
    low_ = low_.cwiseMin(c.a);
    high_ = high_.cwiseMax(c.a);
  }
}

void Trim::add(const BSplineCurve2& edge, double tolerance_u, double tolerance_v) {
  struct Part {
    double t0, t1;
    Vec2 a, b;
    int depth;
  };
  std::vector<Part> stack;
  const auto split = [&](const Part& part) {
    const double middle = 0.5 * (part.t0 + part.t1);
    const Vec2 m = edge.value(middle);
    const Vec2 off = (m - 0.5 * (part.a + part.b)).cwiseAbs();
    if (part.depth >= kMaxDepth || (off.x() <= tolerance_u && off.y() <= tolerance_v)) {
      chords_.push_back({part.a, m});
      chords_.push_back({m, part.b});
      return;
    }
    stack.push_back({middle, part.t1, m, part.b, part.depth + 1});
    stack.push_back({part.t0, middle, part.a, m, part.depth + 1});
  };
  const int first = edge.degree, last = edge.count();
  for (int k = first; k < last; ++k) {
    const double a = edge.knots[static_cast<std::size_t>(k)], b = edge.knots[static_cast<std::size_t>(k + 1)];
    if (!(b > a)) continue;
    for (int i = 0; i < kPiecesPerSpan; ++i) {
      const double t0 = a + (b - a) * i / kPiecesPerSpan, t1 = a + (b - a) * (i + 1) / kPiecesPerSpan;
      stack.push_back({t0, t1, edge.value(t0), edge.value(t1), 0});
      while (!stack.empty()) {
        const Part part = stack.back();
        stack.pop_back();
        split(part);
      }
    }
  }
}

// A chord counts if one of its ends lies above the line and the other not: so a vertex on the line counts once if the
// loop goes through it, and twice or not at all if it only touches. Horizontal chords never count.
std::vector<double> Trim::crossings(double v) const {
  std::vector<double> out;
  for (const Chord& c : chords_) {
    if ((c.a.y() <= v) == (c.b.y() <= v)) continue;
    out.push_back(c.a.x() + (v - c.a.y()) / (c.b.y() - c.a.y()) * (c.b.x() - c.a.x()));
  }
  std::sort(out.begin(), out.end());
  return out;
}

bool Trim::inside(const std::vector<double>& crossings, double u) const {
  if (everything_) return true;
  return (std::upper_bound(crossings.begin(), crossings.end(), u) - crossings.begin()) % 2 == 1;
}

}  // namespace flank::internal::verify
