/// A "jet": the surface near one vertex of a mesh, as a polynomial height field over the tangent plane.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "flank/vec.h"

namespace flank::internal {

/// Heights z(x, y) of degree at most four above the plane through `origin` spanned by the first two columns of `frame`;
/// the third is the direction of the height, on the machining side.
struct Jet {
  static constexpr int kDegree = 4;
  /// Monomials of two variables up to that degree.
  static constexpr int kTerms = 15;

  Vec3 origin = Vec3::Zero();
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  /// Of 1, x, y, x^2, xy, y^2, x^3, x^2 y, ..., y^4, lengths in mm.
  std::array<double, kTerms> c{};

  /// z (mm) and its partial derivatives.
  struct Heights {
    double z, x, y, xx, xy, yy;
  };
  /// Height and its first and second partial derivatives.
  [[nodiscard]] Heights heights(double x, double y) const {
    const double y2 = y * y, x2 = x * x;
    // Coefficients of the powers of x, polynomials in y, and their derivatives in y.
    const double a0 = c[0] + y * (c[2] + y * (c[5] + y * (c[9] + y * c[14])));
    const double a1 = c[1] + y * (c[4] + y * (c[8] + y * c[13]));
    const double a2 = c[3] + y * (c[7] + y * c[12]);
    const double a3 = c[6] + y * c[11];
    const double b0 = c[2] + y * (2.0 * c[5] + y * (3.0 * c[9] + y * 4.0 * c[14]));
    const double b1 = c[4] + y * (2.0 * c[8] + y * 3.0 * c[13]);
    const double b2 = c[7] + y * 2.0 * c[12];
    // The same for the second derivatives in y.
    const double d0 = 2.0 * c[5] + 6.0 * y * c[9] + 12.0 * y2 * c[14];
    const double d1 = 2.0 * c[8] + 6.0 * y * c[13];
    return {a0 + x * (a1 + x * (a2 + x * (a3 + x * c[10]))),
            a1 + x * (2.0 * a2 + x * (3.0 * a3 + x * 4.0 * c[10])),
            b0 + x * (b1 + x * (b2 + x * c[11])),
            2.0 * a2 + 6.0 * x * a3 + 12.0 * x2 * c[10],
            b1 + x * (2.0 * b2 + x * 3.0 * c[11]),
            d0 + x * (d1 + x * 2.0 * c[12])};
  }

  /// The point of the jet above or below q, along the direction of the height.
  [[nodiscard]] Vec3 project(const Vec3& q) const {
    const Vec3 local = frame.transpose() * (q - origin);
    return origin + local[0] * frame.col(0) + local[1] * frame.col(1) + heights(local[0], local[1]).z * frame.col(2);
  }
  /// Unit normal there, on the machining side.
  [[nodiscard]] Vec3 normal(const Vec3& q) const {
    const Vec3 local = frame.transpose() * (q - origin);
    const Heights h = heights(local[0], local[1]);
    return (frame.col(2) - h.x * frame.col(0) - h.y * frame.col(1)).normalized();
  }
};

/// A jet and how well it meets its points.
struct JetFit {
  Jet jet;
  double residual = 0.0;  ///< mm; root of the weighted squares of the heights left, over the degrees of freedom: the
                          ///< noise, if there is only noise
  int degree = 0;         ///< of the polynomial
};

/// Scratch of fit_jet, to be kept between calls.
struct JetWorkspace {
  std::vector<double> x, y, z, weight;
};

/// Weighted least squares through `points`, of degree `degree` or, where the points do not determine it (too few, or on
/// too few lines), the next lower one; a plane through `origin` at the least. Weights fall from 1 at the origin to
/// exp(-falloff) at the farthest point, distances measured with each principal direction of the points scaled to its
/// own extent, so that stretched triangles do no harm.
[[nodiscard]] JetFit fit_jet(std::span<const Vec3> points, const Vec3& origin, const Vec3& normal, int degree,
                             double falloff, JetWorkspace& workspace);

}  // namespace flank::internal
