/// The engagement angle of a tool in a tri-dexel stock, by scanning the front of its contact circles (MATH section 10).
#pragma once

#include <vector>

#include "flank/path/engaged_arcs.h"
#include "flank/path/pose_velocity.h"
#include "flank/verify/stock/dexel_stock.h"

namespace flank::internal::verify {

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

  struct Seen {
    double angle_rad = 0.0, s = 0.0;  ///< the largest of the circles, and where
    std::vector<EngagedArc> arcs;     ///< of all circles
  };
  /// What of the front lies in the stock and in no late pose.
  [[nodiscard]] Seen look(const DexelStock& stock, const MovingTool& tool) const;
  /// s of the circles, mm.
  [[nodiscard]] std::vector<double> heights() const;

 private:
  [[nodiscard]] double height(int ring) const { return radial_.axis_length() * ring / (count_ - 1); }
  /// Of a circle: appended to `arcs`, and their sum.
  double add_arcs(const DexelStock& stock, const MovingTool& tool, int ring, std::vector<EngagedArc>& arcs) const;

  RadialFunction radial_;
  int count_;
};

}  // namespace flank::internal::verify
