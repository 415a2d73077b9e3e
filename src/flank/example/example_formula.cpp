#include "flank/example/example_formula.h"

namespace flank::internal {
namespace {

std::vector<double> equal_steps(int count) {
  std::vector<double> x(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) x[static_cast<std::size_t>(i)] = static_cast<double>(i) / (count - 1);
  return x;
}

}  // namespace

Face interpolated(const std::function<Vec3(double u, double v)>& formula, int count_u, int count_v) {
  const std::vector<double> u = equal_steps(count_u), v = equal_steps(count_v);
  std::vector<Vec3> points;
  for (const double a : u)
    for (const double b : v) points.push_back(formula(a, b));
  Face face;
  face.id = "F1";
  face.surface = interpolate_grid(points, u, v, 3);
  return face;
}

}  // namespace flank::internal
