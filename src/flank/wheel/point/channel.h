/// A channel of a wheel as passes of the tip sphere see it.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "flank/feature/wheel_axis.h"
#include "flank/geom/distance_grid.h"
#include "flank/geom/triangle_bvh.h"
#include "flank/target.h"
#include "flank/wheel/point/tilt_cone.h"

namespace flank::internal {

/// Nothing is owned, and all of it must outlive what is planned with it.
struct FloorChannel {
  WheelAxis axis;
  std::vector<const Target*> floor;  ///< turned about the axis
  std::vector<const Target*> first,
      second;  ///< the sides that bound the channel; a right-handed turn goes from first to second
  std::vector<const Target*> walls;  ///< all that the tool keeps out of besides the floor: sides, edges, tips, fillets
  const TriangleBvh* coarse =
      nullptr;  ///< floor and walls as triangles: where directions are looked for; null: no such search
  /// Distances to `coarse` and to `wheel`, faster and not as exact; null: the triangles are asked.
  const DistanceGrid *distances = nullptr, *wheel_distances = nullptr;
  /// The whole wheel as triangles: above the flank the tool's axis keeps out of it. Null: nothing is asked there.
  const TriangleBvh* wheel = nullptr;
  double reach_mm = 0.0;  ///< no two places of the wheel are farther from each other
  double blade_mm = 0.0;  ///< thickness of the blades at their feet: so far the floor goes on beyond a side's end
};

/// What an earlier pass of the flank has left at a place.
struct SurfaceLeft {
  double height_mm = 0.0;       ///< over it; < 0: the place is cut
  Vec3 normal = Vec3::UnitZ();  ///< unit, away from the material
};

struct PointOptions {
  double tolerance_mm = 0.05;
  double scallop_share = 0.5;  ///< of the tolerance, that scallops take; the rest is for chords and the tip's height
  double enter_share = 0.3;    ///< of the tolerance: so deep a pass may enter a wall; < 0: it keeps off so far
  double most_turn_rad = 0.2;  ///< within `turn_window_mm`: a strip that turns more sharply is two
  double turn_window_mm = 1.0;
  double height_mm = 0.0;  ///< of a roughing layer over the floor; 0: the floor itself
  double apart_mm = 0.0;   ///< between passes; 0: as the scallop says
  TiltCone held = {};      ///< the axes that there may be
  double shank_mm = 0.0;   ///< radius of what stands above the flank, to beyond the wheel
  /// Whether a place of a wall is finished already; empty: none is.
  std::function<bool(const Vec3&)> is_finished = {};
  /// What the flank has left at a place of a face's border, which a pass along it goes on smoothly from; empty: nothing.
  std::function<std::optional<SurfaceLeft>(const Vec3&)> left_by_flank = {};
  bool joins_flank = false;  ///< a pass that goes on so is made where all is finished, too
};

}  // namespace flank::internal
