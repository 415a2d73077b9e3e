#include "flank/surface/nurbs/nurbs_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flank::internal {
namespace {

/// A cell is flat when second differences of its control points are below this share of its edges; an arc then turns by
/// about 0.25.
constexpr double kFlatness = 0.03;
/// The largest edge of a cell as a share of the face's size.
constexpr double kLargestCell = 0.2;
/// The same for a cell that a trim cuts.
constexpr double kLargestCutCell = 0.05;
/// Smaller cells are not cut further, however bent.
constexpr double kSmallestCell = 1e-4;
constexpr int kMaxDepth = 24;
/// How much wider than the cell a descent may roam, on each side.
constexpr double kReach = 0.25;

/// How bent a control net is in each direction, and how long.
struct Shape {
  double length_u = 0.0, length_v = 0.0, bend_u = 0.0, bend_v = 0.0, twist = 0.0;

  Shape(const std::vector<Vec3>& hull, int p, int q) {
    const auto at = [&](int i, int j) -> const Vec3& { return hull[static_cast<std::size_t>(i * (q + 1) + j)]; };
    for (int j = 0; j <= q; ++j) {
      double length = 0.0;
      for (int i = 0; i < p; ++i) length += (at(i + 1, j) - at(i, j)).norm();
      for (int i = 0; i + 2 <= p; ++i)
        // Second differences bound the second derivative by p (p - 1); over 8 it is the height of the arc over its
        // chord.
        bend_u = std::max(bend_u, p * (p - 1) * (at(i, j) - 2.0 * at(i + 1, j) + at(i + 2, j)).norm() / 8.0);
      length_u = std::max(length_u, length);
    }
    for (int i = 0; i <= p; ++i) {
      double length = 0.0;
      for (int j = 0; j < q; ++j) length += (at(i, j + 1) - at(i, j)).norm();
      for (int j = 0; j + 2 <= q; ++j)
        bend_v = std::max(bend_v, q * (q - 1) * (at(i, j) - 2.0 * at(i, j + 1) + at(i, j + 2)).norm() / 8.0);
      length_v = std::max(length_v, length);
    }
    for (int i = 0; i < p; ++i)
      for (int j = 0; j < q; ++j)
        // The mixed second derivative likewise: by a quarter of it the middle of a bilinear net is off its corners'
        // plane.
        twist = std::max(twist, p * q * (at(i, j) - at(i + 1, j) - at(i, j + 1) + at(i + 1, j + 1)).norm() / 4.0);
  }

  /// 0: flat enough, 1: cut u, 2: cut v.
  [[nodiscard]] int cut(double size, double largest) const {
    if (std::max(length_u, length_v) < kSmallestCell * size) return 0;
    const double ru = bend_u / (kFlatness * length_u), rv = bend_v / (kFlatness * length_v);
    if (length_u > 0.0 && ru > 1.0 && !(length_v > 0.0 && rv > ru)) return 1;
    if (length_v > 0.0 && rv > 1.0) return 2;
    const bool twisted =
        twist > 4.0 * kFlatness * std::min(length_u, length_v) && twist > kFlatness * kSmallestCell * size;
    if (twisted || std::max(length_u, length_v) > largest * size) return length_u > length_v ? 1 : 2;
    return 0;
  }
};

/// The larger principal curvature, positive where the surface bends towards n (any length); 0 at a pole.
double largest_curvature(const SurfaceJet& jet, const Vec3& n) {
  const double a = jet.du.squaredNorm(), b = jet.du.dot(jet.dv), c = jet.dv.squaredNorm(), det = a * c - b * b;
  if (!(det > 1e-12 * a * c)) return 0.0;
  const double size = n.norm(), l = jet.duu.dot(n) / size, m = jet.duv.dot(n) / size, q = jet.dvv.dot(n) / size;
  const double mean = 0.5 * (a * q - 2.0 * b * m + c * l) / det, gauss = (l * q - m * m) / det;
  return mean + std::sqrt(std::max(0.0, mean * mean - gauss));
}

/// The part of a zone within [u0, u1] x [v0, v1]; its cells stay those of the zone.
ParameterBox clip(const ParameterBox& zone, double u0, double u1, double v0, double v1) {
  ParameterBox b = zone;
  b.u0 = std::max(zone.u0, u0);
  b.u1 = std::min(zone.u1, u1);
  b.v0 = std::max(zone.v0, v0);
  b.v1 = std::min(zone.v1, v1);
  return b;
}

class Builder {
 public:
  Builder(const NurbsFace& face, int index, FlatCells& out) : face_(face), index_(index), out_(out) {}

  /// Halves a cell, in the direction that bends more, until its net is flat; what lies outside of the trims is
  /// dropped.
  void split(int i, int j, double u0, double u1, double v0, double v1, int depth) {
    const BSplinePatches& s = face_.patches();
    const TrimRegion::Side side = face_.trim().classify({u0, u1, v0, v1});
    if (side == TrimRegion::Side::kOutside) return;
    const double largest = side == TrimRegion::Side::kCut ? kLargestCutCell : kLargestCell;
    std::vector<Vec3> hull = s.hull(i, j, u0, u1, v0, v1);
    const int cut = depth < kMaxDepth ? Shape(hull, s.degree_u(), s.degree_v()).cut(face_.size(), largest) : 0;
    const double mid_u = 0.5 * (u0 + u1), mid_v = 0.5 * (v0 + v1);
    if (cut == 1) {
      split(i, j, u0, mid_u, v0, v1, depth + 1);
      split(i, j, mid_u, u1, v0, v1, depth + 1);
    } else if (cut == 2) {
      split(i, j, u0, u1, v0, mid_v, depth + 1);
      split(i, j, u0, u1, mid_v, v1, depth + 1);
    } else {
      add(i, j, u0, u1, v0, v1, side == TrimRegion::Side::kCut, std::move(hull));
    }
  }

 private:
  void add(int i, int j, double u0, double u1, double v0, double v1, bool cut, std::vector<Vec3>&& hull) {
    FlatCell cell;
    cell.cut = cut;
    cell.face = index_;
    cell.u0 = u0;
    cell.u1 = u1;
    cell.v0 = v0;
    cell.v1 = v1;
    const double mid_u = 0.5 * (u0 + u1), mid_v = 0.5 * (v0 + v1);
    const ParameterBox& d = face_.domain();
    // Within the domain: real footpoints are searched here, those on the extension are followed by track().
    cell.zone = clip(face_.zone_at(mid_u, mid_v), d.u0, d.u1, d.v0, d.v1);
    const double du = kReach * (u1 - u0), dv = kReach * (v1 - v0);
    cell.reach = clip(cell.zone, u0 - du, u1 + du, v0 - dv, v1 + dv);
    SurfaceJet jet;
    face_.patches().evaluate(i, j, mid_u, mid_v, jet);
    cell.center = jet.p;
    const double a = jet.du.squaredNorm(), b = jet.du.dot(jet.dv), c = jet.dv.squaredNorm(), det = a * c - b * b;
    if (det > 1e-12 * a * c) {
      cell.to_u = (c * jet.du - b * jet.dv) / det;
      cell.to_v = (a * jet.dv - b * jet.du) / det;
    }
    measure_curvature(cell, i, j);
    out_.cells.push_back(cell);
    out_.hulls.push_back(std::move(hull));
  }

  /// Geodesic curvature of a line with these derivatives on a surface of this normal, which need not be unit.
  static double geodesic_curvature(const Vec3& d1, const Vec3& d2, const Vec3& normal) {
    const double speed = d1.norm(), area = normal.norm();
    return speed > 0.0 && area > 0.0 ? std::abs(d2.dot(normal.cross(d1))) / (area * speed * speed * speed)
                                     : std::numeric_limits<double>::infinity();
  }

  /// Bounds of the larger principal curvature, seen from either side, from nine places and widened by 0.3 of their
  /// spread; likewise of the curvature of the parameter lines.
  void measure_curvature(FlatCell& cell, int i, int j) const {
    constexpr double kWider = 1.3;
    for (int side = 0; side < 2; ++side) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (int k = 0; k < 9; ++k) {
        const double u = cell.u0 + 0.5 * (k / 3) * (cell.u1 - cell.u0),
                     v = cell.v0 + 0.5 * (k % 3) * (cell.v1 - cell.v0);
        SurfaceJet jet;
        face_.patches().evaluate(i, j, u, v, jet);
        const Vec3 n = jet.du.cross(jet.dv);
        if (k == 4) cell.normal = n.norm() > 0.0 ? Vec3(n.normalized()) : Vec3(Vec3::Zero());
        const double largest = largest_curvature(jet, side == 0 ? n : -n);
        low = std::min(low, largest);
        high = std::max(high, largest);
        cell.line_curvature = std::max({cell.line_curvature, kWider * geodesic_curvature(jet.du, jet.duu, n),
                                        kWider * geodesic_curvature(jet.dv, jet.dvv, n)});
      }
      const double spread = 0.3 * (high - low);
      cell.curvature_low[static_cast<std::size_t>(side)] = low - spread;
      cell.curvature_high[static_cast<std::size_t>(side)] = high + spread;
    }
  }

  const NurbsFace& face_;
  int index_;
  FlatCells& out_;
};

/// How near to a focal point several minima are looked for, relative to the distance.
constexpr double kFocalLow = 0.75, kFocalHigh = 1.3;

}  // namespace

// 1 - d k = 0 for some curvature k of the cell: then minima may lie side by side.
bool can_be_focal(const FlatCell& cell, const Vec3& r) {
  const std::size_t side = r.dot(cell.normal) >= 0.0 ? 0 : 1;
  const double distance = r.norm();
  return distance * cell.curvature_high[side] > kFocalLow && distance * cell.curvature_low[side] < kFocalHigh;
}

bool is_convex(const FlatCell& cell, const Vec3& r) {
  const std::size_t side = r.dot(cell.normal) >= 0.0 ? 0 : 1;
  return r.norm() * std::max(cell.curvature_high[side], cell.line_curvature) <= kFocalLow;
}

void append_flat_cells(const NurbsFace& face, int index, FlatCells& out) {
  const BSplinePatches& s = face.patches();
  const ParameterBox& d = face.domain();
  Builder builder(face, index, out);
  for (int i = d.i0; i <= d.i1; ++i)
    for (int j = d.j0; j <= d.j1; ++j) {
      const double u0 = std::max(d.u0, s.breaks_u()[static_cast<std::size_t>(i)]),
                   u1 = std::min(d.u1, s.breaks_u()[static_cast<std::size_t>(i) + 1]);
      const double v0 = std::max(d.v0, s.breaks_v()[static_cast<std::size_t>(j)]),
                   v1 = std::min(d.v1, s.breaks_v()[static_cast<std::size_t>(j) + 1]);
      if (u0 < u1 && v0 < v1) builder.split(i, j, u0, u1, v0, v1, 0);
    }
}

}  // namespace flank::internal
