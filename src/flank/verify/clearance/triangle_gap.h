/// The signed distance between a triangle and a convex solid of revolution.
#pragma once

#include <array>

#include "flank/verify/clearance/revolved.h"

namespace flank::internal::verify {

/// The closest (outside) or deepest (inside) place of a triangle.
struct TriangleGap {
  double value = 1e300;         ///< least signed distance of the triangle's points; negative: the depth of the deepest
  Vec3 point = Vec3::Zero();    ///< of the triangle
  Vec3 normal = Vec3::UnitX();  ///< gradient of the signed distance there: from the body to the triangle
};

/// Promised accuracy of triangle_gap, mm: of distances, and of depths if no more is allowed. Depths are dearer: inside,
/// the distance is convex but not smooth, and its minimum over a triangle is searched for in two dimensions.
inline constexpr double kTriangleGapErrorMm = 1e-9;
inline constexpr double kDepthErrorMm = 1e-7;

/// The two outward normals, in the body's frame, of the sides of the body that face a point of it most (Revolved::facing).
[[nodiscard]] std::array<Vec3, 2> facing_normals(const Revolved& body, const Vec3& x);

/// What the larger one of two linear functions is at least on a triangle, from their values at its corners: the best that a mean of both gives.
[[nodiscard]] double least_of_larger(const std::array<double, 3>& a, const std::array<double, 3>& b);

/// The triangle in the body's frame (axis of revolution z). Exact to kTriangleGapErrorMm where the value is below
/// `cutoff`; else some value >= cutoff. A depth is the depth of `point` and short of the deepest by no more than
/// `depth_error_mm`. Triangles without area are segments or points.
[[nodiscard]] TriangleGap triangle_gap(const Revolved& body, const std::array<Vec3, 3>& triangle, double cutoff = 1e300,
                                       double depth_error_mm = kDepthErrorMm);

}  // namespace flank::internal::verify
