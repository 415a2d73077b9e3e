/// Directions of the axis over a channel's floor: with room on all sides, and changing slowly.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "flank/wheel/point/tip_room.h"

namespace flank::internal {

/// A net of places on the floor, rows along the channel and columns across it, with a direction at each: of the directions around the
/// floor's normal those with room, chosen so that neighbours are alike, and smoothed as far as the room lasts.
class AxisField {
 public:
  /// `places`: rows * columns, row by row; those without a floor count as absent. `before`: a field over the same rows and columns, null:
  /// none; where its direction has room here, too, it is taken, and no other is looked for.
  AxisField(const TipRoom& room, const std::vector<std::optional<TipRoom::Rest>>& places, int rows, int columns,
            const AxisField* before = nullptr);
  [[nodiscard]] int columns() const { return columns_; }
  /// Between the nodes; row and column from 0 to their number less 1.
  [[nodiscard]] Vec3 at(double row, double column) const;
  /// Of the four nodes around, the nearest one first: what lies between directions with room may have none.
  [[nodiscard]] std::array<Vec3, 4> around(double row, double column) const;
  /// Of the directions that a node tries, the one nearest to a wish with which the tip has room at a place; none: none of them has.
  [[nodiscard]] static std::optional<Vec3> nearest_free(const TipRoom& room, const TipRoom::Rest& place,
                                                        const Vec3& wish, double deeper_mm);
  /// Least room of the nodes that are there, as rough_room() counts, mm.
  [[nodiscard]] double least_room() const;

 private:
  struct Node {
    bool present = false;
    Vec3 center = Vec3::Zero(), normal = Vec3::UnitZ(), axis = Vec3::UnitZ();
    std::vector<double> rooms;  ///< of each direction; empty: the axis is taken as it is
    double room = -1e300;
  };
  /// Whether there is room for a direction, which is then the node's.
  [[nodiscard]] static bool takes(const TipRoom& room, const Vec3& axis, Node& node);
  void look(const TipRoom& room, Node& node) const;
  void choose();
  void smooth(const TipRoom& room);
  void fill();
  [[nodiscard]] std::vector<std::size_t> beside(std::size_t k) const;

  int rows_, columns_;
  TiltCone held_;
  std::vector<Node> nodes_;
};

}  // namespace flank::internal
