#include "flank/surface/mesh/mesh_surface.h"

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

/// w_i = q_i / q with q_i = b_i^3, by the quotient rule; b = (1 - u - v, u, v).
std::array<BlendWeight, 3> weights(double u, double v) {
  const std::array<double, 3> b{1.0 - u - v, u, v};
  constexpr std::array<double, 3> kBu{-1.0, 1.0, 0.0}, kBv{-1.0, 0.0, 1.0};
  std::array<BlendWeight, 3> q;
  BlendWeight sum{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double first = 3.0 * b[i] * b[i], second = 6.0 * b[i];
    q[i] = {b[i] * b[i] * b[i],       first * kBu[i],           first * kBv[i],
            second * kBu[i] * kBu[i], second * kBu[i] * kBv[i], second * kBv[i] * kBv[i]};
    sum.w += q[i].w;
    sum.u += q[i].u;
    sum.v += q[i].v;
    sum.uu += q[i].uu;
    sum.uv += q[i].uv;
    sum.vv += q[i].vv;
  }
  const double inverse = 1.0 / sum.w;
  for (BlendWeight& w : q) {
    w.w *= inverse;
    w.u = (w.u - w.w * sum.u) * inverse;
    w.v = (w.v - w.w * sum.v) * inverse;
    w.uu = (w.uu - 2.0 * w.u * sum.u - w.w * sum.uu) * inverse;
    w.uv = (w.uv - w.u * sum.v - w.v * sum.u - w.w * sum.uv) * inverse;
    w.vv = (w.vv - 2.0 * w.v * sum.v - w.w * sum.vv) * inverse;
  }
  return q;
}

}  // namespace

SurfaceJet JetSurface::jet(int triangle, double u, double v) const { return blended(triangle, u, v, weights(u, v)); }

SurfaceJet JetSurface::blended(int triangle, double u, double v, const std::array<BlendWeight, 3>& blend) const {
  FLANK_ASSERT(triangle >= 0 && static_cast<std::size_t>(triangle) < mesh.triangles.size());
  const Vec3 &a = corner(triangle, 0), eu = corner(triangle, 1) - a, ev = corner(triangle, 2) - a;
  const Vec3 x = a + u * eu + v * ev;
  SurfaceJet s;
  for (int i = 0; i < 3; ++i) {
    const Jet& jet = jets[static_cast<std::size_t>(mesh.triangles[static_cast<std::size_t>(triangle)][i])];
    const Eigen::RowVector3d e1 = jet.frame.col(0).transpose(), e2 = jet.frame.col(1).transpose();
    const Vec3 local = x - jet.origin;
    const double xu = e1 * eu, xv = e1 * ev, yu = e2 * eu, yv = e2 * ev, px = e1 * local, py = e2 * local;
    const Jet::Heights h = jet.heights(px, py);
    const double zu = h.x * xu + h.y * yu, zv = h.x * xv + h.y * yv;
    const double zuu = h.xx * xu * xu + 2.0 * h.xy * xu * yu + h.yy * yu * yu;
    const double zuv = h.xx * xu * xv + h.xy * (xu * yv + xv * yu) + h.yy * yu * yv;
    const double zvv = h.xx * xv * xv + 2.0 * h.xy * xv * yv + h.yy * yv * yv;
    // F_i - x and its derivatives are multiples of the jet's normal, which keeps their differences small and exact.
    const BlendWeight& w = blend[static_cast<std::size_t>(i)];
    const Vec3 n = jet.frame.col(2);
    const double f = h.z - n.dot(local), fu = zu - n.dot(eu), fv = zv - n.dot(ev);
    s.p += (w.w * f) * n;
    s.du += (w.w * fu + w.u * f) * n;
    s.dv += (w.w * fv + w.v * f) * n;
    s.duu += (w.w * zuu + 2.0 * w.u * fu + w.uu * f) * n;
    s.duv += (w.w * zuv + w.u * fv + w.v * fu + w.uv * f) * n;
    s.dvv += (w.w * zvv + 2.0 * w.v * fv + w.vv * f) * n;
  }
  s.p += x;
  s.du += eu;
  s.dv += ev;
  return s;
}

double JetSurface::area(int triangle) const {
  // Radon's seven points.
  const double a = 0.101286507323456, b = 0.470142064105115;
  const double wa = 0.125939180544827 / 2.0, wb = 0.132394152788506 / 2.0, wc = 0.225 / 2.0;
  const auto density = [&](double u, double v) {
    // With linear weights the same surface is run through more evenly than with the cubic ones.
    const std::array<BlendWeight, 3> linear{
        {{1.0 - u - v, -1.0, -1.0, 0.0, 0.0, 0.0}, {u, 1.0, 0.0, 0.0, 0.0, 0.0}, {v, 0.0, 1.0, 0.0, 0.0, 0.0}}};
    const SurfaceJet s = blended(triangle, u, v, linear);
    return s.du.cross(s.dv).norm();
  };
  return wc * density(1.0 / 3.0, 1.0 / 3.0) +
         wa * (density(a, a) + density(a, 1.0 - 2.0 * a) + density(1.0 - 2.0 * a, a)) +
         wb * (density(b, b) + density(b, 1.0 - 2.0 * b) + density(1.0 - 2.0 * b, b));
}

}  // namespace flank::internal
