/// What is left of a blank while it is roughed, as distances at the corners of a grid: a planner's view, not the judge's.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "flank/vec.h"
#include "flank/wheel/rough/cutter.h"

namespace flank::internal {

/// At each corner how deep it is in the material, mm, as far as two cells to either side; between them linear. So the surface is known to a small
/// share of a cell, and what a tool engages to a few degrees. Corners lie in bricks, eight to a side, and a brick that is all air is passed over:
/// what a tool meets again and again, the channel above a layer, costs nothing.
class StockGrid {
 public:
  /// `depth`: of a place in the blank, mm; < 0: outside of it.
  StockGrid(const Box3& box, double cell_mm, const std::function<double(const Vec3&)>& depth);

  /// Takes out what the tool sweeps on its way along poses, one at least. From one to the next a place is as near to the tool as where it
  /// passes it: exact for a cylinder or cone that moves across its axis.
  void cut(const Cutter& cutter, const std::vector<Pose>& poses);
  /// Whether the tool, its tip sphere too, is in the material at all.
  [[nodiscard]] bool meets(const Cutter& cutter, const Pose& pose) const;
  /// The largest of the circles of the flank on the way from one pose to the next, at the second one, radians: as much of what goes ahead as is in the
  /// material.
  [[nodiscard]] double engagement(const Cutter& cutter, const Pose& from, const Pose& to) const;

 private:
  static constexpr int kSide = 8;  ///< corners of a brick, along each direction
  static constexpr std::size_t kCorners = static_cast<std::size_t>(kSide) * kSide * kSide;
  /// The way from a pose to the next.
  struct Motion {
    Pose from;
    Vec3 tip_way, axis_way;
    double moved;   ///< no place of the tool moves more, mm
    double before;  ///< the same of all motions to the end of this one, mm
    [[nodiscard]] double distance(const Cutter& cutter, const Vec3& p) const;
  };
  [[nodiscard]] static std::vector<Motion> motions_of(const Cutter& cutter, const std::vector<Pose>& poses);
  /// A motion that may come to a brick.
  struct Touch {
    std::size_t brick, motion;
  };
  void touched(const Cutter& cutter, const Motion& motion, std::size_t number, std::vector<Touch>& out) const;
  void cut(const Cutter& cutter, const std::vector<Motion>& motions, const Touch* first, const Touch* last);
  /// Of one circle that goes a way.
  [[nodiscard]] double in_material(const Cutter::Circle& circle, const Pose& pose, const Vec3& way) const;
  [[nodiscard]] double depth(const Vec3& p) const;
  /// Whether all is air in a box around a place, as far as a radius.
  [[nodiscard]] bool is_air(const Vec3& middle, double radius) const;
  /// Of a brick's first corner.
  [[nodiscard]] Vec3 corner(std::size_t brick) const;
  [[nodiscard]] std::size_t brick(int x, int y, int z) const {
    return (static_cast<std::size_t>(x) * static_cast<std::size_t>(bricks_[1]) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(bricks_[2]) +
           static_cast<std::size_t>(z);
  }
  double cell_, far_;
  Vec3 low_;
  std::array<int, 3> bricks_;
  std::vector<float> depths_;  ///< brick by brick
  std::vector<char> air_;      ///< of each brick: whether all of its corners are as far outside as is told
};

}  // namespace flank::internal
