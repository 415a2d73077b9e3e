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
  [[nodiscard]] int across() const { return across_; }
  [[nodiscard]] int up() const { return up_; }
  [[nodiscard]] int rows() const { return static_cast<int>(rows_.size()); }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] double cell() const { return cell_; }
  /// Where line and row lie, mm.
  [[nodiscard]] double place_across(int line) const { return low_[across()] + (line + 0.5) * cell_; }
  [[nodiscard]] double place_up(int row) const { return low_[up()] + (row + 0.5) * cell_; }
  /// The inverse, not rounded.
  [[nodiscard]] double line_at(double place) const { return (place - low_[across()]) / cell_ - 0.5; }
  [[nodiscard]] double row_at(double place) const { return (place - low_[up()]) / cell_ - 0.5; }

  /// Where the grid begins, and how many cells along the lines hold the box.
  [[nodiscard]] const Vec3& low() const { return low_; }
  [[nodiscard]] int depth() const { return depth_; }

  /// Takes [low, high] away; returns the length that was material, mm.
  double subtract(int row, int line, double low, double high);
  /// Narrows [low, high] to its part from the first material to the last; false: there is none.
  [[nodiscard]] bool meets(int row, int line, double& low, double& high) const;
  /// Of all lines of a row: where the first material begins and the last ends. A line without any ends before it begins.
  [[nodiscard]] const float* lows(int row) const { return lows_.data() + index(row, 0); }
  [[nodiscard]] const float* highs(int row) const { return highs_.data() + index(row, 0); }
  /// Where the widest gap between these begins and ends: material lies before the one and behind the other. Of a line without a
  /// gap they are where its material ends and begins.
  [[nodiscard]] const float* gap_lows(int row) const { return gap_lows_.data() + index(row, 0); }
  [[nodiscard]] const float* gap_highs(int row) const { return gap_highs_.data() + index(row, 0); }
  [[nodiscard]] bool has_gaps(int row) const { return rows_[static_cast<std::size_t>(row)].chains > 0; }
  /// Whether a line has no gap.
  [[nodiscard]] bool is_whole(int row, int line) const { return chains_[index(row, line)] < 0; }
  /// Whether there is material at a place of the line.
  [[nodiscard]] bool holds(int row, int line, double place) const;
  /// Calls visit(DexelSpan) for all material of a line, in no order.
  template <class Visit>
  void visit(int row, int line, const Visit& visit) const {
    const std::size_t k = index(row, line);
    if (chains_[k] < 0) {
      if (lows_[k] < highs_[k]) visit(DexelSpan{lows_[k], highs_[k]});
      return;
    }
    const std::vector<Link>& links = rows_[static_cast<std::size_t>(row)].links;
    for (int n = chains_[k]; n >= 0; n = links[static_cast<std::size_t>(n)].next)
      visit(links[static_cast<std::size_t>(n)].span);
  }

 private:
  struct Link {
    DexelSpan span;
    int next = -1;
  };
  /// The stretches of those lines that have several.
  struct Row {
    std::vector<Link> links;
    int free = -1;
    int chains = 0;  ///< lines that have several
    [[nodiscard]] int add(const Link& link);
  };
  [[nodiscard]] std::size_t index(int row, int line) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(line);
  }
  double subtract_from_chain(Row& row, std::size_t k, float from, float to);
  /// Gives stretches back that are empty now, and says anew where the line's material begins and ends, and its gap.
  void settle_chain(Row& row, std::size_t k);
  int axis_, across_, up_, width_ = 0, depth_ = 0;
  double cell_;
  Vec3 low_;
  std::vector<float> lows_, highs_, gap_lows_, gap_highs_;  ///< of all lines, row by row
  std::vector<int>
      chains_;  ///< the first of the stretches of a line that has several, in their order; -1: it has one, or none
  std::vector<Row> rows_;
};

}  // namespace flank::internal::verify
