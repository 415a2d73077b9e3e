#include "flank/surface/mesh/mesh_walk.h"

#include <Eigen/LU>
#include <cmath>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

constexpr int kMostSteps = 60;
constexpr int kMostCrossings = 256;

/// A step shorter than this share of the triangle's sides is the last one; the surface moves on by its second-order
/// Taylor polynomial, whose error, like that of the Newton step, is of higher order: below 1e-9 of the side.
constexpr double kLastStep = 2e-5;

/// A free footpoint farther off its normal than this share of its distance and its triangle lies on a ridge.
constexpr double kKink = 1e-6;

/// Least squared sine between S_u and S_v that counts as a surface.
constexpr double kFolded = 1e-12;

/// A weight up to this is zero but for rounding.
constexpr double kOnSide = 1e-14;

/// Least determinant of the Hessian, as a share of that of the metric, for a Newton step; below it (p near or beyond a
/// focal point) the Gauss-Newton matrix gives a descent direction.
constexpr double kLeastHessian = 1e-3;

struct Walker {
  const JetSurface& surface;
  const Vec3& p;
  Reach reach;

  [[nodiscard]] bool open(int triangle, int side) const {
    const int other = surface.neighbor(triangle, side);
    return other < 0 || (reach == Reach::kReal && other >= surface.real_triangles);
  }

  /// The step to take from a place; `held` is set where an open side keeps it from going on.
  Vec2 step(const MeshPlace& at, const SurfaceJet& s, bool& held) const {
    const Vec3 r = s.p - p;
    const Vec2 gradient(r.dot(s.du), r.dot(s.dv));
    Eigen::Matrix2d metric, hessian;
    metric << s.du.dot(s.du), s.du.dot(s.dv), s.du.dot(s.dv), s.dv.dot(s.dv);
    hessian << r.dot(s.duu), r.dot(s.duv), r.dot(s.duv), r.dot(s.dvv);
    hessian += metric;
    // Where the surface folds, S_u and S_v may be parallel; a step along the gradient will do there.
    if (!(metric.determinant() > kFolded * metric(0, 0) * metric(1, 1)))
      metric = Eigen::Matrix2d::Identity() * std::max(metric.trace(), 1e-300);
    const bool convex = hessian.determinant() > kLeastHessian * metric.determinant() && hessian.trace() > 0.0;
    if (!convex) hessian = metric;
    const Vec2 free = -(hessian.inverse() * gradient);
    held = false;
    const std::array<double, 3> b{1.0 - at.u - at.v, at.u, at.v}, db{-free[0] - free[1], free[0], free[1]};
    for (int k = 0; k < 3; ++k) {
      if (b[k] > kOnSide || db[k] >= 0.0 || !open(at.triangle, k)) continue;
      // Along side k only; at a corner of two open sides, the one that is left wins the second time round.
      const std::array<double, 3> along_u{-1.0, 0.0, 1.0}, along_v{1.0, -1.0, 0.0};
      const Vec2 along(along_u[k], along_v[k]);
      held = true;
      return -(along.dot(gradient) / along.dot(hessian * along)) * along;
    }
    return free;
  }

  /// Moves by a step, unfolding the triangles along the way, and stops at open sides. Returns whether one stopped it.
  bool move(MeshPlace& at, Vec2 step) const {
    for (int crossing = 0; crossing < kMostCrossings; ++crossing) {
      std::array<double, 3> b{1.0 - at.u - at.v, at.u, at.v};
      const std::array<double, 3> db{-step[0] - step[1], step[0], step[1]};
      double share = 1.0;
      int side = -1;
      for (int k = 0; k < 3; ++k) {
        if (db[k] >= 0.0 || b[k] + db[k] >= 0.0) continue;
        const double reached = std::max(0.0, b[k]) / -db[k];
        if (side >= 0 && reached >= share) continue;
        share = reached;
        side = k;
      }
      at.u += share * step[0];
      at.v += share * step[1];
      if (side < 0) return false;
      snap(at, side);
      if (open(at.triangle, side)) return true;
      cross(at, side, (1.0 - share) * step, step);
    }
    return false;
  }

  /// Puts a place exactly onto a side.
  static void snap(MeshPlace& at, int side) {
    at.u = std::min(1.0, std::max(0.0, at.u));
    at.v = std::min(1.0, std::max(0.0, at.v));
    if (side == 1) at.u = 0.0;
    if (side == 2) at.v = 0.0;
    if (side == 0) at.v = 1.0 - at.u;
  }

  /// Changes to the triangle across a side; the rest of the step turns about the side into its plane.
  void cross(MeshPlace& at, int side, const Vec2& rest, Vec2& step) const {
    const int from = at.triangle, to = surface.neighbor(from, side);
    const auto& corners = surface.mesh.triangles[static_cast<std::size_t>(from)];
    const auto& others = surface.mesh.triangles[static_cast<std::size_t>(to)];
    const int first = (side + 1) % 3, second = (side + 2) % 3;
    const std::array<double, 3> b{1.0 - at.u - at.v, at.u, at.v};
    int other_side = 0;
    while (other_side < 2 && (others[other_side] == corners[first] || others[other_side] == corners[second]))
      ++other_side;
    std::array<double, 3> c{};
    c[(other_side + 1) % 3] = b[second];
    c[(other_side + 2) % 3] = b[first];
    const Vec3 a = surface.corner(from, first), edge = surface.corner(from, second) - a;
    const Vec3 d = rest[0] * (surface.corner(from, 1) - surface.corner(from, 0)) +
                   rest[1] * (surface.corner(from, 2) - surface.corner(from, 0));
    const double squared = edge.squaredNorm(), along = d.dot(edge) / squared;
    const Vec3 tip = surface.corner(to, other_side) - a;
    const double tip_along = tip.dot(edge) / squared;
    const double height = (tip - tip_along * edge).norm(), out = (d - along * edge).norm();
    // In the other triangle: a unit of its tip's weight rises by `height` and moves by tip_along from the side's first
    // end.
    const double dc = out / height, d_second = along - dc * tip_along;
    std::array<double, 3> dcs{};
    dcs[other_side] = dc;
    dcs[(other_side + 1) % 3] = d_second;
    dcs[(other_side + 2) % 3] = -dc - d_second;
    at = {to, c[1], c[2]};
    step = Vec2(dcs[1], dcs[2]);
  }
};

/// Takes a last, tiny step. A place on a side may end up outside by that much, which the surface allows.
void finish(MeshWalk& walk, const Vec2& step) {
  SurfaceJet& s = walk.jet;
  const double u = step[0], v = step[1];
  s.p += u * s.du + v * s.dv + 0.5 * (u * u * s.duu + 2.0 * u * v * s.duv + v * v * s.dvv);
  s.du += u * s.duu + v * s.duv;
  s.dv += u * s.duv + v * s.dvv;
  walk.place.u += u;
  walk.place.v += v;
  walk.converged = true;
}

}  // namespace

MeshWalk walk_to_footpoint(const JetSurface& surface, const Vec3& p, MeshPlace start, Reach reach) {
  FLANK_ASSERT(start.triangle >= 0 && static_cast<std::size_t>(start.triangle) < surface.mesh.triangles.size());
  const Walker walker{surface, p, reach};
  MeshWalk best;
  best.place = start;
  best.jet = surface.jet(start.triangle, start.u, start.v);
  double least = (best.jet.p - p).squaredNorm();
  Vec2 step = walker.step(best.place, best.jet, best.on_border);
  const double rounding = 1e-30 * p.squaredNorm();
  int unmoved = 0;
  for (int i = 0; i < kMostSteps; ++i) {
    if (step.cwiseAbs().maxCoeff() < kLastStep) {
      finish(best, step);
      return best;
    }
    MeshPlace place = best.place;
    const bool stopped = walker.move(place, step);
    const SurfaceJet jet = surface.jet(place.triangle, place.u, place.v);
    const double squared = (jet.p - p).squaredNorm();
    if (squared > least * (1.0 + 1e-14) + rounding) {
      step *= 0.25;
      continue;
    }
    // At a corner of the border every triangle around it sends the place back to the corner: that is the minimum.
    unmoved = (jet.p - best.jet.p).squaredNorm() <= 1e-24 * jet.du.squaredNorm() ? unmoved + 1 : 0;
    best.place = place;
    best.jet = jet;
    least = squared;
    step = walker.step(best.place, best.jet, best.on_border);
    if (unmoved >= 2) {
      best.on_border = stopped || best.on_border;
      best.converged = true;
      return best;
    }
  }
  return best;
}

Footpoint footpoint_of(const MeshWalk& walk, const Vec3& p, int real_triangles) {
  const SurfaceJet& s = walk.jet;
  Footpoint f;
  f.point = s.p;
  f.u = walk.place.u;
  f.v = walk.place.v;
  f.patch = walk.place.triangle;
  const Vec3 cross = s.du.cross(s.dv);
  const double area = cross.norm();
  const Vec3 normal = area > 0.0 ? Vec3(cross / area) : s.du.unitOrthogonal();
  f.normal = normal;
  const Vec3 d = p - s.p;
  const double length = s.du.norm();
  f.distance = d.dot(f.normal);
  if (walk.place.triangle >= real_triangles) {
    f.location = Location::kExtension;
  } else if (walk.on_border) {
    f.location = Location::kBorder;
    f.distance = f.distance < 0.0 ? -d.norm() : d.norm();
  } else if ((d - f.distance * f.normal).norm() > kKink * (d.norm() + length)) {
    // A minimum on a ridge between jets that differ (crumpled meshes): the distance's gradient is along p - point.
    f.distance = std::copysign(d.norm(), f.distance);
    f.normal = d / f.distance;
  }
  // Second fundamental form in the orthonormal frame e1 along S_u, e2 = n x e1.
  const double slant = s.du.dot(s.dv) / length, height = std::max(area / length, kOnSide * length);
  const Vec3 e1 = s.du / length, e2 = normal.cross(e1);
  const double l = s.duu.dot(normal), m = s.duv.dot(normal), n = s.dvv.dot(normal);
  const double a = l / (length * length);
  const double b = (m / length - slant * a) / height;
  const double c = (n - 2.0 * slant * (m / length) + slant * slant * a) / (height * height);
  const double mean = 0.5 * (a + c), half = 0.5 * (a - c), radius = std::sqrt(half * half + b * b);
  f.k1 = mean - radius;
  f.k2 = mean + radius;
  // Eigenvector of k2, from the larger of the two rows of the matrix less k1.
  const Vec2 direction = half >= 0.0 ? Vec2(radius + half, b) : Vec2(b, radius - half);
  const double size = direction.norm();
  f.d2 = size > 0.0 ? Vec3((direction[0] * e1 + direction[1] * e2) / size) : e1;
  f.d1 = f.d2.cross(normal);
  return f;
}

}  // namespace flank::internal
