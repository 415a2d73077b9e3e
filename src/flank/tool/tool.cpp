#include "flank/tool.h"

#include <cmath>

#include "flank/base/assert.h"

namespace flank {

Vec2 meridian_point(const RadialFunction& radial, double s) {
  const RadialJet f = radial.at(s);
  return {s - f.r * f.d1, f.r * std::sqrt((1.0 - f.d1) * (1.0 + f.d1))};
}

std::vector<Vec2> meridian(const RadialFunction& radial, int count) {
  FLANK_ASSERT(count >= 1);
  std::vector<Vec2> points(static_cast<std::size_t>(count));
  const double length = radial.axis_length();
  for (int i = 0; i < count; ++i)
    points[static_cast<std::size_t>(i)] = meridian_point(radial, count > 1 ? length * i / (count - 1) : 0.0);
  return points;
}

}  // namespace flank
