/// Material on parallel lines: one of the three directions of a tri-dexel stock.
#pragma once

#include <vector>

#include "flank/vec.h"

namespace flank::internal::verify {

/// Material of one line, from low to high along it, mm.
struct DexelSpan {
  float low = 0.0F, high = 0.0F;
};

/// Lines along one axis of the frame, through the middles of square cells. Rows may be changed by different threads.
class DexelField {
 public:
  /// Lines along `axis` (0, 1, 2) through all of the box, in the grid whose cells begin at the box' lower corner.
  DexelField(int axis, const Box3& box, double cell_mm);

  [[nodiscard]] int axis() const { return axis_; }
  /// The axes across the lines: lines of a row differ in across(), rows in up().
  [[nodiscard]] int across() const { return (axis_ + 1) % 3; }
  [[nodiscard]] int up() const { return (axis_ + 2) % 3; }
  [[nodiscard]] int rows() const { return static_cast<int>(rows_.size()); }
  [[nodiscard]] int width() const { return width_; }
  /// Where line and row lie, mm.
  [[nodiscard]] double place_across(int line) const { return low_[across()] + (line + 0.5) * cell_; }
  [[nodiscard]] double place_up(int row) const { return low_[up()] + (row + 0.5) * cell_; }
  /// The inverse, not rounded.
  [[nodiscard]] double line_at(double place) const { return (place - low_[across()]) / cell_ - 0.5; }
  [[nodiscard]] double row_at(double place) const { return (place - low_[up()]) / cell_ - 0.5; }

  /// Takes [low, high] away; returns the length that was material, mm.
  double subtract(int row, int line, double low, double high);
  /// Narrows [low, high] to its part from the first material to the last; false: there is none.
  [[nodiscard]] bool meets(int row, int line, double& low, double& high) const;
  /// Whether there may be material between two places: sure where the line has only one stretch.
  [[nodiscard]] bool may_meet(int row, int line, double low, double high) const {
    const Node& node = rows_[static_cast<std::size_t>(row)].nodes[static_cast<std::size_t>(line)];
    return node.next >= 0 || (node.span.low < node.span.high && node.span.low < high && node.span.high > low);
  }
  /// Whether there is material at a place of the line.
  [[nodiscard]] bool holds(int row, int line, double place) const;
  /// Calls visit(DexelSpan) for all material of a line, in no order.
  template <class Visit>
  void visit(int row, int line, const Visit& visit) const {
    const std::vector<Node>& nodes = rows_[static_cast<std::size_t>(row)].nodes;
    for (int k = line; k >= 0; k = nodes[static_cast<std::size_t>(k)].next) {
      const Node& node = nodes[static_cast<std::size_t>(k)];
      if (node.span.low < node.span.high) visit(node.span);
    }
  }

 private:
  struct Node {
    DexelSpan span;  ///< low >= high: none
    int next = -1;
  };
  /// The first nodes are those of the lines; further ones are chained.
  struct Row {
    std::vector<Node> nodes;
    int free = -1;
  };
  int axis_, width_ = 0;
  double cell_;
  Vec3 low_;
  std::vector<Row> rows_;
};

}  // namespace flank::internal::verify
