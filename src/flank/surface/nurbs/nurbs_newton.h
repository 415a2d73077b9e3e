/// Closest point on one smooth zone of a surface, by Newton's method within a parameter box.
#pragma once

#include "flank/geom/bspline_patches.h"

namespace flank::internal {

/// A parameter rectangle and the knot cells that cover it. Within it the surface is at least C1, so the box ends at
/// creases.
struct ParameterBox {
  double u0 = 0.0, u1 = 0.0, v0 = 0.0, v1 = 0.0;
  int i0 = 0, i1 = 0, j0 = 0, j1 = 0;  ///< first and last cell of each direction
};

/// Where a descent stands. side_u is -1 or +1 where u is held at the lower or upper end of the box by the gradient, 0
/// where u is free.
struct Descent {
  double u = 0.0, v = 0.0;
  SurfaceJet jet;
  double squared = 0.0;  ///< |jet.p - p|^2
  int side_u = 0, side_v = 0;
  /// Hessian over metric of the free parameters at the last step: about (1 - d k1)(1 - d k2); 0 where the Hessian was
  /// not positive definite.
  double stiffness = 1.0;
  enum class End {
    kConverged,  ///< the tangential residual is about 1e-14 of `size`, along the free parameters
    kAbandoned,  ///< it ran into the box's ends where it was told not to
    kSlow        ///< kMaxIterations without convergence
  } end = End::kSlow;
};

inline constexpr int kMaxIterations = 60;

/// Minimises f(u, v) = |S(u, v) - p|^2 / 2 from (x.u, x.v): Newton where the Hessian is positive definite, else
/// Gauss-Newton; steps are halved until f falls and clipped to the box. `size` (mm) is the scale that convergence is
/// measured with. With `abandon` the descent ends as soon as it stays at an end of the box that is not an end of
/// `zone`.
void descend(const BSplinePatches& surface, const Vec3& p, const ParameterBox& box, double size,
             const ParameterBox* zone, Descent& x);

/// Gradient of f with respect to u and v at a jet.
inline double gradient_u(const SurfaceJet& jet, const Vec3& p) { return jet.du.dot(jet.p - p); }
inline double gradient_v(const SurfaceJet& jet, const Vec3& p) { return jet.dv.dot(jet.p - p); }

}  // namespace flank::internal
