#include "flank/example/example_cavity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "flank/error.h"
#include "flank/example/example_formula.h"

namespace flank::internal {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kBend = 0.03;      ///< of the S along the channel, share of its length
constexpr double kSkewness = 0.25;  ///< the deepest place of the hollow lies above the middle

/// Of the wall at +y, before it is moved outwards.
Vec3 wall_point(const CavityShape& shape, double u, double v) {
  const double x = 2.0 * u - 1.0, h = 2.0 * v - 1.0;
  const double hollow = shape.hollow_mm * (1.0 - h * h) * (1.0 + kSkewness * h);
  const double angle = 0.5 * shape.twist_deg * kDegree * x - shape.lean_deg * kDegree;
  const double out = hollow, up = 0.5 * shape.depth_mm * h;
  const double bend = kBend * shape.length_mm * (x * x * x - 0.6 * x);
  return {0.5 * shape.length_mm * x, bend + std::cos(angle) * out - std::sin(angle) * up,
          std::sin(angle) * out + std::cos(angle) * up};
}

/// Of the walls before they are moved apart, from a dense grid.
struct WallExtent {
  double highest_y = -1e300;  ///< of the one at +y
  double least_between =
      1e300;  ///< how far it lies beyond the other one where that is least, mm; < 0: they cross there
};

/// Twist and bend carry both walls along: what lies between them is known from the same section of both.
WallExtent extent(const CavityShape& shape) {
  constexpr int kSteps = 200;
  WallExtent out;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const double u = static_cast<double>(i) / kSteps, v = static_cast<double>(j) / kSteps;
      const double here = wall_point(shape, u, v).y(), across = -wall_point(shape, 1.0 - u, v).y();
      out.highest_y = std::max(out.highest_y, here);
      out.least_between = std::min(out.least_between, here - across);
    }
  return out;
}

/// Across the end on the side of `sign`, as wide and high as the channel there and a little more.
Face cross_wall(const CavityShape& shape, double sign) {
  const double x = 0.5 * sign * shape.length_mm, y = 0.6 * shape.width_mm, z = 0.6 * shape.depth_mm;
  return interpolated([&](double u, double v) { return Vec3(x, sign * y * (1.0 - 2.0 * u), z * (2.0 * v - 1.0)); }, 4,
                      4);
}

}  // namespace

std::vector<Face> cavity_walls(const CavityShape& shape) {
  if (!(shape.width_mm > 0.0 && shape.depth_mm > 0.0 && shape.length_mm > 0.0 && shape.hollow_mm >= 0.0))
    throw UsageError("width, depth and length of a cavity must be above 0 mm, and its hollow depth at least 0 mm");
  if (!(std::abs(shape.twist_deg) <= 60.0)) throw UsageError("the twist of a cavity must lie in [-60, 60] degrees");
  if (!(std::abs(shape.lean_deg) <= 45.0))
    throw UsageError("the lean of the walls of a cavity must lie in [-45, 45] degrees");
  const WallExtent walls_at = extent(shape);
  const double out = 0.5 * shape.width_mm - walls_at.highest_y, least = walls_at.least_between + 2.0 * out;
  if (!(least > 0.0))
    throw UsageError(
        fmt::format("the walls of a cavity {:.4g} mm wide over all would meet; with this lean, twist and hollow the "
                    "width must be above {:.4g} mm",
                    shape.width_mm, shape.width_mm - least));
  constexpr int kAlong = 24, kUp = 16;
  std::vector<Face> walls;
  // u runs along x and v up: S_u x S_v looks to -y, into the channel.
  walls.push_back(interpolated([&](double u, double v) { return Vec3(wall_point(shape, u, v) + out * Vec3::UnitY()); },
                               kAlong, kUp));
  walls.push_back(interpolated(
      [&](double u, double v) {
        const Vec3 p = wall_point(shape, u, v) + out * Vec3::UnitY();
        return Vec3(-p.x(), -p.y(), p.z());
      },
      kAlong, kUp));
  walls.back().id = "F2";
  if (shape.end_wall) walls.push_back(cross_wall(shape, 1.0));
  if (shape.start_wall) walls.push_back(cross_wall(shape, -1.0));
  for (std::size_t k = 2; k < walls.size(); ++k) walls[k].id = "F" + std::to_string(k + 1);
  return walls;
}

}  // namespace flank::internal
