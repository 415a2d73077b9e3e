/// What is left of a blank while it is roughed, as distances at the corners of a grid: a planner's view, not the judge's.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "flank/vec.h"
#include "flank/wheel/rough/cutter.h"

namespace flank::internal {

/// At each corner how deep it is in the material, mm, as far as two cells to either side; between them linear. So the surface is known to a small
/// share of a cell, and what a tool engages to a few degrees.
class StockGrid {
 public:
  /// `depth`: of a place in the blank, mm; < 0: outside of it.
  StockGrid(const Box3& box, double cell_mm, const std::function<double(const Vec3&)>& depth);

  /// Takes out what the tool sweeps between two poses.
  void cut(const Cutter& cutter, const Pose& from, const Pose& to);
  /// Whether the tool, its tip sphere too, is in the material at all.
  [[nodiscard]] bool meets(const Cutter& cutter, const Pose& pose) const;
  /// The largest of the circles of the flank on the way from one pose to the next, at the second one, radians: as much of the half that goes ahead
  /// as is in the material.
  [[nodiscard]] double engagement(const Cutter& cutter, const Pose& from, const Pose& to) const;

 private:
  void cut(const Cutter& cutter, const Pose& pose);
  [[nodiscard]] double depth(const Vec3& p) const;
  [[nodiscard]] std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(x) * static_cast<std::size_t>(count_[1]) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(count_[2]) +
           static_cast<std::size_t>(z);
  }
  double cell_, far_;
  Vec3 low_;
  std::array<int, 3> count_;
  std::vector<float> depths_;
};

}  // namespace flank::internal
