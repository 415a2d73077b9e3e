/// The engagement angle of a tool in a tri-dexel stock, by scanning the front of its contact circles (MATH section 10).
#pragma once

#include "flank/verify/stock/dexel_stock.h"

namespace flank::internal::verify {

/// How the axis moves at a pose: per mm of way, or in any other measure of time.
struct PoseVelocity {
  Vec3 tip = Vec3::Zero(), axis = Vec3::Zero();
  [[nodiscard]] Vec3 at(double s) const { return tip + s * axis; }
};

/// A tool on its way through a stock. What it took last is not cut from the stock yet: the front would lie in the surface
/// that it has just made, and there no stock of lines can tell one side from the other. A few cells farther on it can.
struct MovingTool {
  const ToolSolid* solid = nullptr;
  Pose pose;
  PoseVelocity velocity;
  const LatePoses* lately = nullptr;  ///< poses before this one that the stock still has, as near as they must be
  /// What cuts of the stock leave between them, mm: ridges that are so low are not the part's, and no chip that is so thin can be
  /// told from them. So what the tool meets must reach so far into its circles.
  double grain_mm = 0.0;
  std::vector<EmptyBlocks>* empty = nullptr;  ///< where the stock is known to have nothing, for one that is asked often
};

/// Measures on circles of some heights. Immutable.
class FrontScan {
 public:
  /// `count` (>= 2) circles at equal steps of s, both ends of the axis among them.
  FrontScan(const RadialFunction& radial, int count);

  struct Largest {
    double angle_rad = 0.0, s = 0.0;
  };
  /// The largest over the circles: the measure of the front that lies in the stock and in no late pose.
  [[nodiscard]] Largest largest(const DexelStock& stock, const MovingTool& tool) const;
  /// Of the circle of s, in [0, L], mm.
  [[nodiscard]] double angle(const DexelStock& stock, const MovingTool& tool, double s) const;

 private:
  RadialFunction radial_;
  int count_;
};

}  // namespace flank::internal::verify
