#include "flank/surface/nurbs/nurbs_samples.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

constexpr int kSpeedProbes = 16;
constexpr int kSpeedCells = 64;
constexpr int kCutGrid = 4;
constexpr double kMaxLines = 20000.0;

/// Grid lines over [low, high], about `spacing` apart along the mean iso-line: speed(x, k) is the length of the
/// derivative on iso-line k.
template <class Speed>
std::vector<double> grid_lines(double low, double high, double spacing, const Speed& speed) {
  // Arc length up to each cell, as the mean over several iso-lines.
  std::vector<double> cumulated{0.0};
  for (int k = 0; k < kSpeedCells; ++k) {
    double sum = 0.0;
    for (int line = 0; line < kSpeedProbes; ++line)
      sum += speed(low + (high - low) * (k + 0.5) / kSpeedCells, (line + 0.5) / kSpeedProbes);
    cumulated.push_back(cumulated.back() + sum * (high - low) / (kSpeedCells * kSpeedProbes));
  }
  const int count = static_cast<int>(std::clamp(std::ceil(cumulated.back() / spacing), 1.0, kMaxLines));
  std::vector<double> lines{low};
  for (int k = 1, cell = 0; k < count; ++k) {
    // The parameter at which the arc length reaches k of `count` equal shares, linear within a cell.
    const double target = cumulated.back() * k / count;
    while (cell + 1 < kSpeedCells && cumulated[static_cast<std::size_t>(cell) + 1] < target) ++cell;
    const double c0 = cumulated[static_cast<std::size_t>(cell)], c1 = cumulated[static_cast<std::size_t>(cell) + 1];
    lines.push_back(low + (high - low) * (cell + (c1 > c0 ? (target - c0) / (c1 - c0) : 0.5)) / kSpeedCells);
  }
  lines.push_back(high);
  return lines;
}

/// One sample for a cell of the grid; a cell that a trim cuts is represented by its part inside, found on 4 x 4
/// subcells.
void append_cell(const NurbsFace& face, int index, const ParameterRectangle& r, std::vector<SurfaceSample>& out) {
  const TrimRegion::Side side = face.trim().classify(r);
  if (side == TrimRegion::Side::kOutside) return;
  const double du = r.u1 - r.u0, dv = r.v1 - r.v0;
  Vec2 middle(r.u0 + 0.5 * du, r.v0 + 0.5 * dv);
  double area = 0.0;
  if (side == TrimRegion::Side::kInside) {
    area = trimmed_area(face, r, 0);
  } else {
    std::vector<Vec2> inside;
    for (int k = 0; k < kCutGrid * kCutGrid; ++k) {
      const Vec2 q(r.u0 + (k / kCutGrid + 0.5) / kCutGrid * du, r.v0 + (k % kCutGrid + 0.5) / kCutGrid * dv);
      if (!face.inside(q[0], q[1])) continue;
      const SurfaceJet jet = face.jet_within(q[0], q[1]);
      area += du * dv / (kCutGrid * kCutGrid) * jet.du.cross(jet.dv).norm();
      inside.push_back(q);
    }
    if (inside.empty()) return;
    // The sample must lie on the face: the inner subcell nearest to their mean.
    if (!face.inside(middle[0], middle[1])) {
      Vec2 mean = Vec2::Zero();
      for (const Vec2& q : inside) mean += q / static_cast<double>(inside.size());
      const auto gap = [&](const Vec2& q) { return (q - mean).cwiseQuotient(Vec2(du, dv)).squaredNorm(); };
      middle = *std::min_element(inside.begin(), inside.end(),
                                 [&](const Vec2& a, const Vec2& b) { return gap(a) < gap(b); });
    }
  }
  const SurfaceJet jet = face.jet_within(middle[0], middle[1]);
  out.push_back({jet.p, face.normal(jet, middle[0], middle[1]), area, middle[0], middle[1], index});
}

}  // namespace

// Cells that a trim cuts are quartered `depth` times; the rest is a matter of the Gauss points.
double trimmed_area(const NurbsFace& face, const ParameterRectangle& r, int depth) {
  const double du = r.u1 - r.u0, dv = r.v1 - r.v0, mid_u = r.u0 + 0.5 * du, mid_v = r.v0 + 0.5 * dv;
  const TrimRegion::Side side = face.trim().classify(r);
  if (side == TrimRegion::Side::kOutside) return 0.0;
  if (side == TrimRegion::Side::kCut && depth > 0)
    return trimmed_area(face, {r.u0, mid_u, r.v0, mid_v}, depth - 1) +
           trimmed_area(face, {mid_u, r.u1, r.v0, mid_v}, depth - 1) +
           trimmed_area(face, {r.u0, mid_u, mid_v, r.v1}, depth - 1) +
           trimmed_area(face, {mid_u, r.u1, mid_v, r.v1}, depth - 1);
  // 3 x 3 Gauss points, those inside where a trim passes.
  const double offset = 0.5 * std::sqrt(0.6);
  double area = 0.0;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j) {
      const double u = mid_u + i * offset * du, v = mid_v + j * offset * dv;
      if (side == TrimRegion::Side::kCut && !face.inside(u, v)) continue;
      const SurfaceJet jet = face.jet_within(u, v);
      area += (i == 0 ? 8.0 : 5.0) * (j == 0 ? 8.0 : 5.0) / 324.0 * du * dv * jet.du.cross(jet.dv).norm();
    }
  return area;
}

void append_samples(const NurbsFace& face, int index, double spacing_mm, std::vector<SurfaceSample>& out) {
  const BSplinePatches& s = face.patches();
  const ParameterBox& d = face.domain();
  const auto u = grid_lines(d.u0, d.u1, spacing_mm,
                            [&](double x, double t) { return s.jet(x, d.v0 + t * (d.v1 - d.v0)).du.norm(); });
  const auto v = grid_lines(d.v0, d.v1, spacing_mm,
                            [&](double x, double t) { return s.jet(d.u0 + t * (d.u1 - d.u0), x).dv.norm(); });
  for (std::size_t i = 0; i + 1 < u.size(); ++i)
    for (std::size_t j = 0; j + 1 < v.size(); ++j) append_cell(face, index, {u[i], u[i + 1], v[j], v[j + 1]}, out);
}

}  // namespace flank::internal
