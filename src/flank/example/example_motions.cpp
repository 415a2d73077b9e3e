#include "flank/example/example_motions.h"

#include "flank/error.h"

namespace flank::internal {
namespace {

using Poles = Eigen::Matrix<double, 3, 4>;

BSplineCurve3 bezier(const Poles& poles) {
  BSplineCurve3 curve;
  curve.degree = 3;
  curve.knots = uniform_knots(3, 4);
  curve.poles = poles;
  return curve;
}

/// Rails of a motion whose point at `held` of the axis length runs along `path` (mm); one column a control point.
RuledMotion motion(double axis_length, const Poles& path, double held, const Poles& direction) {
  return {axis_length, bezier(path - held * axis_length * direction), bezier(direction)};
}

Poles columns(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  Poles poles;
  poles << a, b, c, d;
  return poles;
}

}  // namespace

RuledMotion example_motion(int number, double axis_length) {
  switch (number) {
    case 1:
      return motion(axis_length, columns({0, 0, 0}, {24, 5, 0.5}, {47, 6, 1}, {70, 1.5, 2}), 0.0,
                    columns({0, -0.12, 0.99}, {0.05, -0.05, 1}, {0.08, 0.06, 1}, {0.06, 0.16, 0.98}));
    case 2:
      // The direction turns from -35 to +35 degrees about x: a circular arc as a Bezier curve.
      return motion(axis_length, columns({0, 0, 0}, {27, 2, 0}, {53, 3, 0}, {80, 2, 1}), 0.5,
                    columns({0, -0.574, 0.819}, {0.02, -0.23, 1.06}, {0.03, 0.23, 1.06}, {0, 0.574, 0.819}));
    case 3:
      return motion(axis_length, columns({0, 0, 0}, {30, 12, 2}, {55, -12, 4}, {85, 0, 5}), 0.5,
                    columns({-0.15, 0.05, 0.99}, {0.1, -0.1, 1}, {0.2, 0.1, 0.99}, {0, 0.15, 0.99}));
    default:
      throw InternalError("example motions are numbered 1 to 3, got " + std::to_string(number));
  }
}

RuledMotion facing_motion(double axis_length) {
  return motion(axis_length, columns({70, -15, 1}, {46, -19, 1.5}, {23, -21, 1}, {0, -14, 0}), 0.0,
                columns({0.02, 0.06, 1}, {0.03, -0.03, 1}, {0, -0.1, 1}, {-0.04, -0.14, 0.99}));
}

}  // namespace flank::internal
