/// Surfaces given by formulas, with their fundamental forms and true distances, independent of the library's.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>

#include "flank/target.h"

namespace flank::internal::testing {

/// A surface's point and its derivatives at one (u, v); the machining side is that of su x sv.
struct ShapeJet {
  Vec3 p, su, sv, suu, suv, svv;
};
using Shape = std::function<ShapeJet(double u, double v)>;

/// The same surface with the other machining side, at (-u, v).
inline Shape turned_round(const Shape& shape) {
  return [=](double u, double v) {
    ShapeJet j = shape(-u, v);
    j.su = -j.su;
    j.suv = -j.suv;
    return j;
  };
}

/// Ring torus, u around the ring, v around the tube from the outer equator.
inline Shape torus_shape(double ring, double tube) {
  return [=](double u, double v) {
    const double c = std::cos(u), s = std::sin(u), cv = std::cos(v), sv = std::sin(v), w = ring + tube * cv;
    return ShapeJet{{w * c, w * s, tube * sv},
                    {-w * s, w * c, 0.0},
                    {-tube * sv * c, -tube * sv * s, tube * cv},
                    {-w * c, -w * s, 0.0},
                    {tube * sv * s, -tube * sv * c, 0.0},
                    {-tube * cv * c, -tube * cv * s, -tube * sv}};
  };
}

/// The torus' exact signed distance, positive outside its tube.
inline double torus_distance(double ring, double tube, const Vec3& p) {
  return std::hypot(std::hypot(p.x(), p.y()) - ring, p.z()) - tube;
}

inline Shape ellipsoid_shape(const Vec3& axes) {
  return [=](double u, double v) {
    const double c = std::cos(u), s = std::sin(u), cv = std::cos(v), sv = std::sin(v);
    const auto scaled = [&](double x, double y, double z) { return Vec3(axes.x() * x, axes.y() * y, axes.z() * z); };
    return ShapeJet{scaled(cv * c, cv * s, sv),  scaled(-cv * s, cv * c, 0.0), scaled(-sv * c, -sv * s, cv),
                    scaled(-cv * c, -cv * s, 0), scaled(sv * s, -sv * c, 0.0), scaled(-cv * c, -cv * s, -sv)};
  };
}

/// z = (a u^2 - b v^2) / 2 + c u v^2, normal up: a saddle whose curvatures are not constant.
inline Shape saddle_shape(double a, double b, double c) {
  return [=](double u, double v) {
    return ShapeJet{{u, v, 0.5 * (a * u * u - b * v * v) + c * u * v * v},
                    {1.0, 0.0, a * u + c * v * v},
                    {0.0, 1.0, -b * v + 2.0 * c * u * v},
                    {0.0, 0.0, a},
                    {0.0, 0.0, 2.0 * c * v},
                    {0.0, 0.0, -b + 2.0 * c * u}};
  };
}

/// Point, normal and principal curvatures from the two fundamental forms.
inline Footpoint shape_foot(const Shape& shape, double u, double v) {
  const ShapeJet j = shape(u, v);
  Footpoint foot;
  foot.point = j.p;
  foot.normal = j.su.cross(j.sv).normalized();
  // Of any size, as other tests use it: compiling one for each size takes longer than all these tests run.
  Eigen::MatrixXd first(2, 2), second(2, 2);
  first << j.su.dot(j.su), j.su.dot(j.sv), j.su.dot(j.sv), j.sv.dot(j.sv);
  second << j.suu.dot(foot.normal), j.suv.dot(foot.normal), j.suv.dot(foot.normal), j.svv.dot(foot.normal);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(second, first);
  foot.k1 = eigen.eigenvalues()[0];
  foot.k2 = eigen.eigenvalues()[1];
  foot.d1 = (eigen.eigenvectors()(0, 0) * j.su + eigen.eigenvectors()(1, 0) * j.sv).normalized();
  foot.d2 = (eigen.eigenvectors()(0, 1) * j.su + eigen.eigenvectors()(1, 1) * j.sv).normalized();
  return foot;
}

/// Signed distance of p to the shape: Newton on the gradient of |S - p|^2, from (u, v).
inline double shape_distance(const Shape& shape, const Vec3& p, double u, double v) {
  for (int step = 0; step < 30; ++step) {
    const ShapeJet j = shape(u, v);
    const Vec3 e = j.p - p;
    Eigen::Matrix2d hessian;
    const double cross = j.su.dot(j.sv) + e.dot(j.suv);
    hessian << j.su.dot(j.su) + e.dot(j.suu), cross, cross, j.sv.dot(j.sv) + e.dot(j.svv);
    const Eigen::Vector2d move = hessian.fullPivLu().solve(Eigen::Vector2d(-e.dot(j.su), -e.dot(j.sv)));
    u += move.x();
    v += move.y();
    if (move.norm() < 1e-15) break;
  }
  const ShapeJet j = shape(u, v);
  return (p - j.p).dot(j.su.cross(j.sv).normalized());
}

/// Value, first and second derivative of a function at 0 by central differences of fourth order.
inline Vec3 differences(const std::function<double(double)>& f, double h) {
  const double a = f(-2.0 * h), b = f(-h), c = f(0.0), d = f(h), e = f(2.0 * h);
  return {c, (a - 8.0 * b + 8.0 * d - e) / (12.0 * h), (-a + 16.0 * b - 30.0 * c + 16.0 * d - e) / (12.0 * h * h)};
}

}  // namespace flank::internal::testing
