#include "flank/surface/nurbs/nurbs_newton.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

/// A step shorter than this share of `size` is the last one: the error after it is of the order of its square.
constexpr double kLastStep = 1e-7;
/// The same where convergence is not quadratic (Gauss-Newton).
constexpr double kLastLinearStep = 1e-13;

struct Step {
  double du = 0.0, dv = 0.0;
  double shrink = 0.0;  ///< what the squared length of the step is multiplied with before it is compared with
                        ///< kLastStep^2; < 0: not quadratic
};

/// Gradient, metric and Hessian of f at one point.
struct Quadratic {
  double gu, gv, a, b, c, huu, huv, hvv;

  Quadratic(const SurfaceJet& jet, const Vec3& p) {
    const Vec3 r = jet.p - p;
    gu = jet.du.dot(r);
    gv = jet.dv.dot(r);
    a = jet.du.squaredNorm();
    b = jet.du.dot(jet.dv);
    c = jet.dv.squaredNorm();
    huu = a + jet.duu.dot(r);
    huv = b + jet.duv.dot(r);
    hvv = c + jet.dvv.dot(r);
  }

  [[nodiscard]] double squared_length(double du, double dv) const {
    return a * du * du + 2.0 * b * du * dv + c * dv * dv;
  }

  /// Newton's step where f is convex enough for it, else Gauss-Newton's, which always goes down, else one parameter at
  /// a time (the tangents are parallel: a pole). 1e-6 of the metric: below it the minimum is so soft that Newton's step
  /// runs away.
  [[nodiscard]] Step both() const {
    const double metric = a * c - b * b, hessian = huu * hvv - huv * huv;
    if (huu > 0.0 && hessian > 1e-6 * metric && hessian > 0.0) {
      const double ratio = std::max(1.0, metric / hessian);
      return {(huv * gv - hvv * gu) / hessian, (huv * gu - huu * gv) / hessian, ratio * ratio};
    }
    if (metric > 1e-12 * a * c) return {(b * gv - c * gu) / metric, (b * gu - a * gv) / metric, -1.0};
    return {a > 0.0 ? -gu / a : 0.0, c > 0.0 ? -gv / c : 0.0, -1.0};
  }

  /// A step of one parameter while the other one is moved by a given amount.
  static double one(double gradient, double second, double first, double& shrink) {
    if (second > 1e-6 * first) {
      const double ratio = std::max(1.0, first / second);
      shrink = shrink < 0.0 ? -1.0 : ratio * ratio;
      return -gradient / second;
    }
    shrink = -1.0;
    return first > 0.0 ? -gradient / first : 0.0;
  }
};

/// The step within the box from x, and what holds x at the box. At a bound that the gradient presses against, the
/// parameter is held and the other one moves alone; a step that leaves the box is clipped where it hits, and the other
/// parameter answers.
Step clipped_step(const Quadratic& q, const ParameterBox& box, Descent& x) {
  x.side_u = x.u <= box.u0 && q.gu > 0.0 ? -1 : x.u >= box.u1 && q.gu < 0.0 ? 1 : 0;
  x.side_v = x.v <= box.v0 && q.gv > 0.0 ? -1 : x.v >= box.v1 && q.gv < 0.0 ? 1 : 0;
  Step s;
  if (x.side_u != 0 && x.side_v != 0) return s;
  if (x.side_u != 0) {
    s.dv = Quadratic::one(q.gv, q.hvv, q.c, s.shrink);
  } else if (x.side_v != 0) {
    s.du = Quadratic::one(q.gu, q.huu, q.a, s.shrink);
  } else {
    s = q.both();
    const double du = std::clamp(x.u + s.du, box.u0, box.u1) - x.u;
    const double dv = std::clamp(x.v + s.dv, box.v0, box.v1) - x.v;
    if (du != s.du &&
        std::abs(du) * std::abs(s.dv) <= std::abs(dv) * std::abs(s.du)) {  // u hits first: v answers to the clipped u
      s.du = du;
      s.dv = Quadratic::one(q.gv + q.huv * du, q.hvv, q.c, s.shrink);
    } else if (dv != s.dv) {
      s.dv = dv;
      s.du = Quadratic::one(q.gu + q.huv * dv, q.huu, q.a, s.shrink);
    }
  }
  s.du = std::clamp(x.u + s.du, box.u0, box.u1) - x.u;
  s.dv = std::clamp(x.v + s.dv, box.v0, box.v1) - x.v;
  return s;
}

/// Moves the jet by a step so small that third-order terms are below round-off.
void advance(SurfaceJet& jet, double du, double dv) {
  jet.p += du * (jet.du + 0.5 * du * jet.duu + dv * jet.duv) + dv * (jet.dv + 0.5 * dv * jet.dvv);
  jet.du += du * jet.duu + dv * jet.duv;
  jet.dv += du * jet.duv + dv * jet.dvv;
}

bool held_inside_zone(const Descent& x, const ParameterBox& box, const ParameterBox& zone) {
  return (x.side_u < 0 && box.u0 > zone.u0) || (x.side_u > 0 && box.u1 < zone.u1) ||
         (x.side_v < 0 && box.v0 > zone.v0) || (x.side_v > 0 && box.v1 < zone.v1);
}

}  // namespace

void descend(const BSplinePatches& surface, const Vec3& p, const ParameterBox& box, double size,
             const ParameterBox* zone, Descent& x) {
  x.u = std::clamp(x.u, box.u0, box.u1);
  x.v = std::clamp(x.v, box.v0, box.v1);
  x.end = Descent::End::kSlow;
  Descent trial = x;
  int held = 0;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const int i = std::clamp(surface.cell_u(trial.u), box.i0, box.i1);
    const int j = std::clamp(surface.cell_v(trial.v), box.j0, box.j1);
    surface.evaluate(i, j, trial.u, trial.v, trial.jet);
    trial.squared = (trial.jet.p - p).squaredNorm();
    // Uphill, by more than round-off: half the step, as often as it takes.
    if (iteration > 0 && trial.squared > x.squared * (1.0 + 1e-13)) {
      trial.u = 0.5 * (trial.u + x.u);
      trial.v = 0.5 * (trial.v + x.v);
      if (trial.u == x.u && trial.v == x.v) return;
      continue;
    }
    const Quadratic q(trial.jet, p);
    const Step s = clipped_step(q, box, trial);
    x = trial;
    if (zone != nullptr) {
      // Twice, since the first step from a start at the box's side may still turn back.
      held = held_inside_zone(x, box, *zone) ? held + 1 : 0;
      if (held >= 2) {
        x.end = Descent::End::kAbandoned;
        return;
      }
    }
    x.stiffness = s.shrink < 0.0 ? 0.0 : s.shrink > 1.0 ? 1.0 / std::sqrt(s.shrink) : 1.0;
    const double length = q.squared_length(s.du, s.dv);
    const double last = s.shrink < 0.0 ? kLastLinearStep : kLastStep;
    trial.u = x.u + s.du;
    trial.v = x.v + s.dv;
    if (length * std::max(s.shrink, 1.0) > last * last * size * size) continue;
    x.end = Descent::End::kConverged;
    // The last step is so short that the jet is moved by Taylor's formula instead of being evaluated once more.
    const bool same_cell = std::clamp(surface.cell_u(trial.u), box.i0, box.i1) == i &&
                           std::clamp(surface.cell_v(trial.v), box.j0, box.j1) == j;
    if (s.du == 0.0 && s.dv == 0.0) return;
    x.u = trial.u;
    x.v = trial.v;
    if (same_cell)
      advance(x.jet, s.du, s.dv);
    else
      surface.evaluate(std::clamp(surface.cell_u(x.u), box.i0, box.i1), std::clamp(surface.cell_v(x.v), box.j0, box.j1),
                       x.u, x.v, x.jet);
    x.squared = (x.jet.p - p).squaredNorm();
    return;
  }
}

}  // namespace flank::internal
