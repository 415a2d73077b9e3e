#include <algorithm>
#include <array>
#include <cmath>

#include "flank/error.h"
#include "flank/judge.h"
#include "flank/verify/trim.h"

namespace flank {
namespace {

using namespace internal::verify;

constexpr int kProbes = 8;               ///< per knot span and direction at most, to measure how the parameters stretch
constexpr int kMostProbes = 192;         ///< per direction, but one a knot span
constexpr int kMaxCellsPerSide = 20000;  ///< bounds memory if the spacing is absurdly small for the face
/// Of |S_u|^2 + |S_v|^2: a tangent parallelogram with less area is degenerate (a pole), and has no curvature to
/// compute.
constexpr double kDegenerate = 1e-12;
constexpr int kSubRows = 6;            ///< a cell on the trim is measured along this many lines of constant v
constexpr double kFlatCell = 0.01;     ///< bend by size up to which the middle of a cell gives its area
constexpr double kBorderShare = 1e-6;  ///< of the parameter range: chords that tell how far the loops reach
constexpr double kTrimShare = 1e-3;    ///< trim chords stay within this share of a cell

struct Range {
  double low = 0.0, high = 0.0;
};

/// Places inside the range: kProbes a knot span, away from the knots themselves.
std::vector<double> probes(const std::vector<double>& knots, int degree, int count, Range range) {
  std::vector<double> out;
  const int per_span = std::clamp(kMostProbes / std::max(1, count - degree), 1, kProbes);
  for (int k = degree; k < count; ++k) {
    const double a = std::max(range.low, knots[static_cast<std::size_t>(k)]);
    const double b = std::min(range.high, knots[static_cast<std::size_t>(k + 1)]);
    if (!(b > a)) continue;
    for (int i = 0; i < per_span; ++i) out.push_back(a + (b - a) * (i + 0.5) / per_span);
  }
  return out;
}

/// Borders of cells along one parameter, such that the longest iso-line piece in a cell is about the spacing: equal
/// steps of the integral of the largest speed across the other parameter.
template <class Speed>
std::vector<double> cell_borders(const std::vector<double>& along, Range range, double spacing, const Speed& speed) {
  std::vector<double> borders{range.low}, lengths{0.0};
  for (std::size_t i = 0; i < along.size(); ++i) {
    const double end = i + 1 < along.size() ? 0.5 * (along[i] + along[i + 1]) : range.high;
    lengths.push_back(lengths.back() + (end - borders.back()) * speed(along[i]));
    borders.push_back(end);
  }
  // Held in bounds as a real number: beyond them it need not fit into an integer.
  const int cells = static_cast<int>(std::clamp(std::ceil(lengths.back() / spacing), 1.0, 1.0 * kMaxCellsPerSide));
  std::vector<double> out{range.low};
  std::size_t k = 1;
  for (int i = 1; i < cells; ++i) {
    const double wanted = lengths.back() * i / cells;
    while (lengths[k] < wanted) ++k;
    const double share = (wanted - lengths[k - 1]) / (lengths[k] - lengths[k - 1]);
    out.push_back(borders[k - 1] + share * (borders[k] - borders[k - 1]));
  }
  out.push_back(range.high);
  return out;
}

/// The part of a cell that lies inside the trim: its share, and a place in it (the middle of the cell if that is
/// inside).
struct CellPart {
  double share = 0.0;
  double u = 0.0, v = 0.0;
};

/// Crossings of the lines through the sub-cells of one row of cells, and of its middle line.
struct RowCrossings {
  std::array<std::vector<double>, kSubRows> sub;
  std::vector<double> middle;
};

/// Length of [low, high] inside the crossings of its line, and the middle of the longest piece inside.
double inside_length(const std::vector<double>& crossings, Range u, double& middle) {
  double length = 0.0, longest = 0.0;
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
    const double a = std::max(u.low, crossings[k]), b = std::min(u.high, crossings[k + 1]);
    if (!(b > a)) continue;
    length += b - a;
    if (b - a > longest) longest = b - a, middle = 0.5 * (a + b);
  }
  return length;
}

CellPart inside_part(const Trim& trim, const RowCrossings& row, Range u, Range v) {
  CellPart part{1.0, 0.5 * (u.low + u.high), 0.5 * (v.low + v.high)};
  if (trim.everything()) return part;
  const bool middle_inside = trim.inside(row.middle, part.u);
  double inside = 0.0, nearest = 1e300;
  for (int j = 0; j < kSubRows; ++j) {
    double middle = part.u;
    const double length = inside_length(row.sub[static_cast<std::size_t>(j)], u, middle);
    inside += length;
    const double away = std::abs(j + 0.5 - 0.5 * kSubRows);
    if (middle_inside || !(length > 0.0) || away >= nearest) continue;
    nearest = away;
    part.u = middle;
    part.v = v.low + (v.high - v.low) * (j + 0.5) / kSubRows;
  }
  part.share = inside / (kSubRows * (u.high - u.low));
  return part;
}

RowCrossings row_crossings(const Trim& trim, Range v) {
  RowCrossings row;
  if (trim.everything()) return row;
  for (int j = 0; j < kSubRows; ++j)
    row.sub[static_cast<std::size_t>(j)] = trim.crossings(v.low + (v.high - v.low) * (j + 0.5) / kSubRows);
  row.middle = trim.crossings(0.5 * (v.low + v.high));
  return row;
}

/// Largest |normal curvature| at a point, by the second fundamental form in an orthonormal tangent frame; 0 where the
/// face is degenerate.
double largest_curvature(const SurfaceJet& j) {
  const Vec3 cross = j.du.cross(j.dv);
  const double area = cross.norm();
  if (!(area > kDegenerate * (j.du.squaredNorm() + j.dv.squaredNorm()))) return 0.0;
  const Vec3 n = cross / area;
  const double e = j.du.squaredNorm(), f = j.du.dot(j.dv), g = j.dv.squaredNorm();
  const double l = n.dot(j.duu), m = n.dot(j.duv), k = n.dot(j.dvv);
  const double mean = 0.5 * (e * k - 2.0 * f * m + g * l) / (area * area);
  const double gauss = (l * k - m * m) / (area * area);
  return std::abs(mean) + std::sqrt(std::max(0.0, mean * mean - gauss));
}

/// Mean of |S_u x S_v| over a cell, by Gauss's rule of two by two places.
double mean_stretch(const BSplineSurface& s, Range u, Range v) {
  constexpr double kGauss =
      0.28867513459481287;  // 1 / (2 sqrt(3)): places of the rule, from the middle, over the width
  const double uc = 0.5 * (u.low + u.high), vc = 0.5 * (v.low + v.high);
  const double du = kGauss * (u.high - u.low), dv = kGauss * (v.high - v.low);
  double sum = 0.0;
  for (double x : {uc - du, uc + du}) {
    for (double y : {vc - dv, vc + dv}) {
      const SurfaceJet jet = s.jet(x, y);
      sum += jet.du.cross(jet.dv).norm();
    }
  }
  return 0.25 * sum;
}

/// Unit normal, away from the material of the face's solid; zero where the face is degenerate.
Vec3 normal_at(const SurfaceJet& jet, bool reversed) {
  const Vec3 cross = jet.du.cross(jet.dv);
  const double length = cross.norm();
  return length > 0.0 ? Vec3((reversed ? -1.0 : 1.0) / length * cross) : Vec3(Vec3::Zero());
}

/// Adds the sample of a cell, and what it says about the spacing and the curvature.
void add_cell(FaceSamples& out, const BSplineSurface& s, const CellPart& part, Range u, Range v, bool reversed) {
  const double du = u.high - u.low, dv = v.high - v.low;
  const SurfaceJet jet = s.jet(part.u, part.v);
  const Vec3 a = 0.5 * du * jet.du, b = 0.5 * dv * jet.dv;
  const double half_diagonal = std::max((a + b).norm(), (a - b).norm());
  // Taylor's second-order term at the corners of the cell, half a side away in u and in v.
  const double bend = 0.125 * (jet.duu.norm() * du * du + 2.0 * jet.duv.norm() * du * dv + jet.dvv.norm() * dv * dv);
  const double stretch = bend < kFlatCell * half_diagonal ? jet.du.cross(jet.dv).norm() : mean_stretch(s, u, v);
  out.points.push_back(jet.p);
  out.areas.push_back(part.share * du * dv * stretch);
  out.spacing_mm = std::max(out.spacing_mm, half_diagonal + bend);
  out.reaches_mm.push_back(half_diagonal + bend);
  out.curvatures_per_mm.push_back(largest_curvature(jet));
  out.normals.push_back(normal_at(jet, reversed));
}

void require_usable(const Face& face, double spacing_mm) {
  if (!(spacing_mm > 0.0)) throw UsageError("sample spacing " + std::to_string(spacing_mm) + " mm: must be > 0");
  for (const Vec3& p : face.surface.poles)
    if (!p.allFinite()) throw InputError("face " + face.id + " has a control point that is not finite");
}

}  // namespace

FaceSamples sample_face(const Face& face, double spacing_mm, bool target) {
  require_usable(face, spacing_mm);
  const BSplineSurface& s = face.surface;
  Range u{s.u_first(), s.u_last()}, v{s.v_first(), s.v_last()};
  const Trim border(face.loops, kBorderShare * (u.high - u.low), kBorderShare * (v.high - v.low));
  if (!border.everything()) {
    // Cells end where the loops end, so that a trim along an iso-line cuts none of them.
    u = {std::max(u.low, border.low().x()), std::min(u.high, border.high().x())};
    v = {std::max(v.low, border.low().y()), std::min(v.high, border.high().y())};
  }
  const std::vector<double> at_u = probes(s.knots_u, s.degree_u, s.count_u, u);
  const std::vector<double> at_v = probes(s.knots_v, s.degree_v, s.count_v, v);
  const auto speed_u = [&](double x) {
    double largest = 0.0;
    for (double y : at_v) largest = std::max(largest, s.jet(x, y).du.norm());
    return largest;
  };
  const auto speed_v = [&](double y) {
    double largest = 0.0;
    for (double x : at_u) largest = std::max(largest, s.jet(x, y).dv.norm());
    return largest;
  };
  const std::vector<double> us = cell_borders(at_u, u, spacing_mm, speed_u);
  const std::vector<double> vs = cell_borders(at_v, v, spacing_mm, speed_v);
  const Trim trim(face.loops, kTrimShare * (u.high - u.low) / static_cast<double>(us.size()),
                  kTrimShare * (v.high - v.low) / static_cast<double>(vs.size()));

  FaceSamples out;
  out.face = face.id;
  out.target = target;
  out.of_solid = face.of_solid;
  for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
    const Range cell_v{vs[j], vs[j + 1]};
    const RowCrossings row = row_crossings(trim, cell_v);
    for (std::size_t i = 0; i + 1 < us.size(); ++i) {
      const Range cell_u{us[i], us[i + 1]};
      const CellPart part = inside_part(trim, row, cell_u, cell_v);
      if (!(part.share > 0.0)) continue;
      add_cell(out, s, part, cell_u, cell_v, face.reversed);
    }
  }
  return out;
}

}  // namespace flank
