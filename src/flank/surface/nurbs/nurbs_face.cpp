#include "flank/surface/nurbs/nurbs_face.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

constexpr int kProbes = 24;  ///< iso-lines and points that lengths and closures are judged by
constexpr double kSameBorder =
    1e-7;  ///< borders closer than this share of the size are one seam, shorter ones are a pole
constexpr double kSmoothJoin = 1e-7;  ///< relative jump of a derivative below which a full knot is no crease
constexpr int kMaxHops = 12;          ///< zones that one descent may cross

double lerp(double a, double b, double t) { return a + (b - a) * t; }

/// Length of the iso-line from (u0, v0) to (u1, v1), by chords.
double iso_length(const BSplineSurface& s, double u0, double v0, double u1, double v1) {
  double length = 0.0;
  Vec3 last = s.value(u0, v0);
  for (int k = 1; k <= 2 * kProbes; ++k) {
    const double t = k / (2.0 * kProbes);
    const Vec3 next = s.value(lerp(u0, u1, t), lerp(v0, v1, t));
    length += (next - last).norm();
    last = next;
  }
  return length;
}

/// Cells of a rectangle. One that only touches its upper side does not belong to it.
ParameterBox box_of(const BSplinePatches& s, double u0, double u1, double v0, double v1) {
  ParameterBox b{u0, u1, v0, v1, s.cell_u(u0), s.cell_u(u1), s.cell_v(v0), s.cell_v(v1)};
  // cell_u takes a knot for the beginning of the cell behind it.
  if (b.i1 > b.i0 && s.breaks_u()[static_cast<std::size_t>(b.i1)] >= u1) --b.i1;
  if (b.j1 > b.j0 && s.breaks_v()[static_cast<std::size_t>(b.j1)] >= v1) --b.j1;
  return b;
}

/// Index of the interval that holds x; outside, that of the nearest end.
int interval(const std::vector<double>& ends, double x) {
  const auto it = std::upper_bound(ends.begin() + 1, ends.end() - 1, x);
  return static_cast<int>(it - ends.begin()) - 1;
}

}  // namespace

NurbsFace::NurbsFace(const Face& face, int side, const ExtensionOptions& options)
    : sign_((face.reversed ? -1.0 : 1.0) * (side < 0 ? -1.0 : 1.0)) {
  const BSplineSurface& s = face.surface;
  const ParameterRectangle whole{s.u_first(), s.u_last(), s.v_first(), s.v_last()};
  trim_ = TrimRegion(face.loops, whole);
  const ParameterRectangle& box = trim_.box();
  // The cells follow below, when the extended surface exists; borders and margins need the parameters alone.
  domain_ = {box.u0, box.u1, box.v0, box.v1, 0, 0, 0, 0};
  find_borders(s);
  // The untrimmed rest of the surface is the extension as far as it goes.
  const ParameterMargins m = margins(s, options);
  const ParameterMargins missing{
      std::max(0.0, m.u_low - (box.u0 - whole.u0)), std::max(0.0, m.u_high - (whole.u1 - box.u1)),
      std::max(0.0, m.v_low - (box.v0 - whole.v0)), std::max(0.0, m.v_high - (whole.v1 - box.v1))};
  const BSplineSurface wide = extend(s, missing, options.fit_share);
  patches_ = BSplinePatches(wide);
  domain_ = box_of(patches_, box.u0, box.u1, box.v0, box.v1);
  extended_ = box_of(patches_, std::max(wide.u_first(), box.u0 - m.u_low), std::min(wide.u_last(), box.u1 + m.u_high),
                     std::max(wide.v_first(), box.v0 - m.v_low), std::min(wide.v_last(), box.v1 + m.v_high));
  find_zones(wide);
}

/// Size, seams and poles, judged by samples: a border is closed if it is its opposite one, a pole if it is one point.
void NurbsFace::find_borders(const BSplineSurface& s) {
  Box3 box;
  for (int i = 0; i <= kProbes; ++i)
    for (int j = 0; j <= kProbes; ++j)
      box.add(s.value(lerp(domain_.u0, domain_.u1, i / double(kProbes)),
                      lerp(domain_.v0, domain_.v1, j / double(kProbes))));
  size_ = box.diagonal();
  const double tolerance = kSameBorder * size_;
  closed_u_ = closed_v_ = true;
  pole_.fill(true);
  const ParameterBox& d = domain_;
  const Vec3 low = s.value(d.u0, d.v0), high = s.value(d.u1, d.v1);
  for (int k = 0; k <= kProbes; ++k) {
    const double u = lerp(d.u0, d.u1, k / double(kProbes)), v = lerp(d.v0, d.v1, k / double(kProbes));
    const Vec3 left = s.value(d.u0, v), right = s.value(d.u1, v), bottom = s.value(u, d.v0), top = s.value(u, d.v1);
    closed_u_ = closed_u_ && (left - right).norm() <= tolerance;
    closed_v_ = closed_v_ && (bottom - top).norm() <= tolerance;
    pole_[0] = pole_[0] && (left - low).norm() <= tolerance;
    pole_[1] = pole_[1] && (right - high).norm() <= tolerance;
    pole_[2] = pole_[2] && (bottom - low).norm() <= tolerance;
    pole_[3] = pole_[3] && (top - high).norm() <= tolerance;
  }
  // Two poles at the same place are no seam.
  closed_u_ = closed_u_ && !(pole_[0] && pole_[1]);
  closed_v_ = closed_v_ && !(pole_[2] && pole_[3]);
}

ParameterMargins NurbsFace::margins(const BSplineSurface& s, const ExtensionOptions& options) const {
  // The margin in parameters whose length is length_share of the mean iso-line, at the mean speed of the outer
  // fit_share.
  const ParameterBox& d = domain_;
  const double range_u = d.u1 - d.u0, range_v = d.v1 - d.v0;
  double length_u = 0.0, length_v = 0.0;
  std::array<double, 4> outer{};
  for (int k = 0; k <= kProbes; ++k) {
    const double u = lerp(d.u0, d.u1, k / double(kProbes)), v = lerp(d.v0, d.v1, k / double(kProbes));
    const double fu = options.fit_share * range_u, fv = options.fit_share * range_v;
    length_u += iso_length(s, d.u0, v, d.u1, v);
    length_v += iso_length(s, u, d.v0, u, d.v1);
    outer[0] += iso_length(s, d.u0, v, d.u0 + fu, v);
    outer[1] += iso_length(s, d.u1 - fu, v, d.u1, v);
    outer[2] += iso_length(s, u, d.v0, u, d.v0 + fv);
    outer[3] += iso_length(s, u, d.v1 - fv, u, d.v1);
  }
  const auto margin = [&](int border, double range, double length) {
    const bool closed = border < 2 ? closed_u_ : closed_v_;
    // A closed surface goes on by itself, and beyond a pole there is nothing to go on to.
    if (closed || pole_[static_cast<std::size_t>(border)] || options.length_share <= 0.0) return 0.0;
    // Files with uneven parameters: the range near the border may stand for much more or less length than its share.
    const double speed_share = outer[static_cast<std::size_t>(border)] / (options.fit_share * length);
    return options.length_share * range / std::clamp(speed_share, 0.2, 5.0);
  };
  return {margin(0, range_u, length_u), margin(1, range_u, length_u), margin(2, range_v, length_v),
          margin(3, range_v, length_v)};
}

void NurbsFace::find_zones(const BSplineSurface& s) {
  // A full knot can be a crease: where a first derivative jumps relative to its length.
  const auto creased = [&](bool along_u, int cell) {
    const double knot = (along_u ? patches_.breaks_u() : patches_.breaks_v())[static_cast<std::size_t>(cell)];
    const double low = along_u ? extended_.v0 : extended_.u0, high = along_u ? extended_.v1 : extended_.u1;
    for (int k = 0; k <= 2 * kProbes; ++k) {
      const double x = lerp(low, high, k / (2.0 * kProbes));
      SurfaceJet a, b;
      const int other = along_u ? patches_.cell_v(x) : patches_.cell_u(x);
      if (along_u) {
        patches_.evaluate(cell - 1, other, knot, x, a);
        patches_.evaluate(cell, other, knot, x, b);
      } else {
        patches_.evaluate(other, cell - 1, x, knot, a);
        patches_.evaluate(other, cell, x, knot, b);
      }
      const Vec3 da = along_u ? a.du : a.dv, db = along_u ? b.du : b.dv;
      if ((da - db).norm() > kSmoothJoin * (da.norm() + db.norm())) return true;
    }
    return false;
  };
  const auto ends = [&](bool along_u) {
    const auto& breaks = along_u ? patches_.breaks_u() : patches_.breaks_v();
    const auto& knots = along_u ? s.knots_u : s.knots_v;
    const int degree = along_u ? s.degree_u : s.degree_v;
    const double low = along_u ? extended_.u0 : extended_.v0, high = along_u ? extended_.u1 : extended_.v1;
    std::vector<double> result{low};
    for (int cell = 1; cell + 1 < static_cast<int>(breaks.size()); ++cell) {
      const double knot = breaks[static_cast<std::size_t>(cell)];
      if (knot <= low || knot >= high) continue;
      // Fewer folds than the degree leave a continuous derivative: only full knots are looked at.
      if (std::count(knots.begin(), knots.end(), knot) >= degree && creased(along_u, cell)) result.push_back(knot);
    }
    result.push_back(high);
    return result;
  };
  ends_u_ = ends(true);
  ends_v_ = ends(false);
  for (std::size_t i = 0; i + 1 < ends_u_.size(); ++i)
    for (std::size_t j = 0; j + 1 < ends_v_.size(); ++j)
      zones_.push_back(box_of(patches_, ends_u_[i], ends_u_[i + 1], ends_v_[j], ends_v_[j + 1]));
}

std::vector<double> NurbsFace::within(const std::vector<double>& ends, double low, double high) {
  std::vector<double> result;
  for (double x : ends)
    if (x > low && x < high) result.push_back(x);
  return result;
}

// Cells of the domain only: beside the border the cells of the extension are other polynomials.
SurfaceJet NurbsFace::jet_within(double u, double v) const {
  SurfaceJet jet;
  patches_.evaluate(std::clamp(patches_.cell_u(u), domain_.i0, domain_.i1),
                    std::clamp(patches_.cell_v(v), domain_.j0, domain_.j1), u, v, jet);
  return jet;
}

int NurbsFace::zone_u(double u) const { return interval(ends_u_, u); }
int NurbsFace::zone_v(double v) const { return interval(ends_v_, v); }

bool NurbsFace::hop_u(const Vec3& p, int& zone_i, int zone_j, Descent& x) const {
  const int count = static_cast<int>(ends_u_.size()) - 1;
  int next = zone_i + x.side_u;
  double u = x.u;
  // Round the seam of a closed surface.
  if (next < 0 || next >= count) {
    if (!closed_u_) return false;
    next = next < 0 ? count - 1 : 0;
    u = next == 0 ? extended_.u0 : extended_.u1;
  }
  const ParameterBox& b = zone(next, zone_j);
  SurfaceJet jet;
  patches_.evaluate(x.side_u > 0 ? b.i0 : b.i1, std::clamp(patches_.cell_v(x.v), b.j0, b.j1), u, x.v, jet);
  // Beyond the crease the distance would grow: the minimum lies on the crease.
  if (gradient_u(jet, p) * x.side_u >= 0.0) return false;
  zone_i = next;
  x.u = u;
  return true;
}

bool NurbsFace::hop_v(const Vec3& p, int zone_i, int& zone_j, Descent& x) const {
  const int count = static_cast<int>(ends_v_.size()) - 1;
  int next = zone_j + x.side_v;
  double v = x.v;
  if (next < 0 || next >= count) {
    if (!closed_v_) return false;
    next = next < 0 ? count - 1 : 0;
    v = next == 0 ? extended_.v0 : extended_.v1;
  }
  const ParameterBox& b = zone(zone_i, next);
  SurfaceJet jet;
  patches_.evaluate(std::clamp(patches_.cell_u(x.u), b.i0, b.i1), x.side_v > 0 ? b.j0 : b.j1, x.u, v, jet);
  if (gradient_v(jet, p) * x.side_v >= 0.0) return false;
  zone_j = next;
  x.v = v;
  return true;
}

bool NurbsFace::at_pole(double u, double v) const {
  const ParameterBox& d = domain_;
  return (pole_[0] && u <= d.u0) || (pole_[1] && u >= d.u1) || (pole_[2] && v <= d.v0) || (pole_[3] && v >= d.v1);
}

// A descent within one zone, which is smooth. Held by a crease, it goes on in the next zone if that leads down.
Footpoint NurbsFace::track(const Vec3& p, double u, double v, bool& ok) const {
  Descent x;
  x.u = u;
  x.v = v;
  int zone_i = zone_u(u), zone_j = zone_v(v);
  // Bounded: two zones that point at each other would be hopped between for ever.
  for (int hop = 0; hop < kMaxHops; ++hop) {
    descend(patches_, p, zone(zone_i, zone_j), size_, nullptr, x);
    if (x.side_u != 0 && hop_u(p, zone_i, zone_j, x)) continue;
    if (x.side_v != 0 && hop_v(p, zone_i, zone_j, x)) continue;
    break;
  }
  const bool held = x.side_u != 0 || x.side_v != 0;
  // Held at a pole, a descent cannot turn round it, since all directions of u are the same point there: the caller
  // searches anew.
  ok = x.end == Descent::End::kConverged && !(held && at_pole(x.u, x.v));
  const bool outer = held && ((x.side_u < 0 && x.u <= extended_.u0) || (x.side_u > 0 && x.u >= extended_.u1) ||
                              (x.side_v < 0 && x.v <= extended_.v0) || (x.side_v > 0 && x.v >= extended_.v1));
  const ParameterBox& d = domain_;
  const bool strictly = x.u > d.u0 && x.u < d.u1 && x.v > d.v0 && x.v < d.v1;
  const Location location = outer                                       ? Location::kBorder
                            : ((!held || strictly) && inside(x.u, x.v)) ? Location::kInside
                                                                        : Location::kExtension;
  return footpoint(p, x.u, x.v, x.jet, !held, location);
}

/// At a pole the cross product vanishes: the normal a little towards the middle of the face stands for it.
Vec3 NurbsFace::normal(const SurfaceJet& jet, double u, double v) const {
  const Vec3 n = jet.du.cross(jet.dv);
  const double length = n.norm();
  if (length > 1e-9 * jet.du.norm() * jet.dv.norm() && length > 0.0 && !at_pole(u, v)) return (sign_ / length) * n;
  const double mid_u = 0.5 * (domain_.u0 + domain_.u1), mid_v = 0.5 * (domain_.v0 + domain_.v1);
  const SurfaceJet near = patches_.jet(lerp(u, mid_u, 1e-5), lerp(v, mid_v, 1e-5));
  return sign_ * near.du.cross(near.dv).normalized();
}

Footpoint NurbsFace::footpoint(const Vec3& p, double u, double v, const SurfaceJet& jet, bool along_normal,
                               Location location) const {
  Footpoint f;
  f.point = jet.p;
  f.u = u;
  f.v = v;
  f.location = location;
  const Vec3 r = p - jet.p;
  f.normal = normal(jet, u, v);
  f.distance = r.dot(f.normal);
  if (!along_normal) {
    const double length = r.norm();
    f.distance = f.distance < 0.0 ? -length : length;
    // On a crease or the real border the distance grows along p - point: that is its gradient.
    if (location != Location::kBorder && length > 1e-9 * size_) f.normal = r / f.distance;
  }
  const Vec3 n = along_normal ? f.normal : normal(jet, u, v);
  const double a = jet.du.squaredNorm(), b = jet.du.dot(jet.dv), c = jet.dv.squaredNorm(), det = a * c - b * b;
  f.d1 = a > 0.0 ? Vec3(jet.du / std::sqrt(a)) : n.unitOrthogonal();
  f.d2 = n.cross(f.d1);
  if (!(det > 1e-18 * a * c) || at_pole(u, v)) return f;  // a pole: curvature is undefined
  // Second fundamental form in the orthonormal frame (Su / |Su|, n x that), then the eigenvalues of a symmetric 2 x 2.
  const double l = jet.duu.dot(n), m = jet.duv.dot(n), q = jet.dvv.dot(n), ratio = b / a;
  const Vec3 e1 = f.d1, e2 = n.cross(e1);
  const double flip = e2.dot(jet.dv) < 0.0 ? -1.0 : 1.0;
  const double h11 = l / a, h12 = flip * (m - ratio * l) / std::sqrt(det),
               h22 = (q - ratio * (2.0 * m - ratio * l)) * a / det;
  const double mean = 0.5 * (h11 + h22), half = 0.5 * (h11 - h22), radius = std::hypot(half, h12);
  f.k1 = mean - radius;
  f.k2 = mean + radius;
  if (!(radius > 1e-14 * (std::abs(mean) + radius))) return f;
  // Direction of k2: the longer of the two eigenvector formulas.
  double x = half + radius, y = h12;
  if (half < 0.0) {
    x = h12;
    y = radius - half;
  }
  const double length = std::hypot(x, y);
  f.d2 = (x / length) * e1 + (y / length) * e2;
  f.d1 = f.d2.cross(n);
  return f;
}

}  // namespace flank::internal
