#include "flank/io/tool/mill_outline.h"

#include <cmath>

#include "flank/error.h"

namespace flank::internal {

ToolOutline mill_outline(const Mill& mill, const std::string& file) {
  ToolOutline outline;
  outline.bottom = 0.0;
  outline.ball = mill.ball > 0.0;
  outline.corner_mm = mill.corner;
  const double slope = std::tan(mill.angle);
  const Vec2 begin = outline.ball ? Vec2(mill.ball * (1.0 - std::sin(mill.angle)), mill.ball * std::cos(mill.angle))
                                  : Vec2(mill.corner, mill.tip_radius);
  if (!(mill.height > begin.x())) throw InputError(file + ": the cutting edges end below the flank's beginning");
  outline.flank = {{begin, {mill.height, begin.y() + slope * (mill.height - begin.x())}, 0.0}};
  return outline;
}

}  // namespace flank::internal
