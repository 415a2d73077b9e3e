/// A whole program replayed in a tri-dexel stock, pose by pose, in the order of machining.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/path.h"
#include "flank/path/engaged_arcs.h"
#include "flank/verify/stock/dexel_stock.h"

namespace flank::internal::verify {

struct ReplayOptions {
  int circles = 9;  ///< heights at which the engagement is measured; 0: it is not
  double scallop_cells =
      0.05;  ///< between two poses that are cut one after the other, no more is left of what joins them
};

/// What one pose did; its engagement is the largest of the motion to it from the pose before, at places as near as cuts are. Poses
/// nearer to each other than cuts need to be are passed over: nothing is in them, and their volume is in the next one.
struct PoseReplay {
  double angle_rad = 0.0, s = 0.0;  ///< largest engagement of the circles, and where on the axis, mm
  double volume_mm3 = 0.0;          ///< removed on the way from the pose before
  bool measured = false;            ///< not passed over
  /// Of each circle where most of it was engaged: from and to.
  std::vector<EngagedArc> arcs;
};

struct StripReplay {
  std::string kind;
  double way_mm = 0.0;  ///< of the axis' middle
  double volume_mm3 = 0.0;
  double angle_rad = 0.0;  ///< largest
  std::size_t pose = 0;    ///< where
  std::size_t places = 0;  ///< at which it was measured
  std::vector<PoseReplay> poses;
};

struct StockReplay {
  double cell_mm = 0.0;
  double before_mm3 = 0.0, after_mm3 = 0.0;
  std::vector<StripReplay> strips;
  std::vector<double> heights;  ///< of the circles, s, mm
  /// Largest over the strips of a kind; all: an empty one. Radians.
  [[nodiscard]] double largest(const std::string& kind = "") const;
};

/// Cuts `stock` by all strips. Throws InputError for a tool that is not legitimate. The same for any number of threads.
[[nodiscard]] StockReplay replay(DexelStock& stock, const RadialFunction& radial, const Path& path,
                                 const ReplayOptions& options = {});

/// What is in the stock along a ray from a place of a face, outwards.
struct RayLeft {
  double over_mm = 0.0;     ///< length of the longest stretch of material on the ray
  double entered_mm = 0.0;  ///< how far inside the face the stock begins; 0: it reaches the face
};
/// `reach`: length of the ray, mm. Looks every half cell, from one cell on.
[[nodiscard]] RayLeft left_along(const DexelStock& stock, const Vec3& point, const Vec3& normal, double reach_mm);

}  // namespace flank::internal::verify
