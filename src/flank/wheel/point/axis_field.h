/// Directions of the axis over a channel's floor: with room on all sides, and changing slowly.
#pragma once

#include <vector>

#include "flank/wheel/point/tip_room.h"

namespace flank::internal {

/// A net of places on the floor, rows along the channel and columns across it, with a direction at each: of the directions around the
/// floor's normal those with room, chosen so that neighbours are alike, and smoothed as far as the room lasts.
class AxisField {
 public:
  /// `places`: rows * columns, row by row; those without a floor count as absent.
  AxisField(const TipRoom& room, const std::vector<std::optional<TipRoom::Rest>>& places, int rows, int columns);
  /// Between the nodes; row and column from 0 to their number less 1.
  [[nodiscard]] Vec3 at(double row, double column) const;
  /// Least room of the nodes that are there, as rough_room() counts, mm.
  [[nodiscard]] double least_room() const;

 private:
  struct Node {
    bool present = false;
    Vec3 center = Vec3::Zero(), normal = Vec3::UnitZ(), axis = Vec3::UnitZ();
    std::vector<double> rooms;  ///< of each direction
    double room = -1e300;
  };
  void look(const TipRoom& room, Node& node) const;
  void choose();
  void smooth(const TipRoom& room);
  void fill();
  [[nodiscard]] Vec3 direction(const Node& node, std::size_t k) const;
  [[nodiscard]] std::vector<std::size_t> beside(std::size_t k) const;

  int rows_, columns_;
  std::vector<Node> nodes_;
};

}  // namespace flank::internal
