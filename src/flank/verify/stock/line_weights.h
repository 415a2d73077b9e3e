/// How much of the volume each line of a stock stands for.
#pragma once

#include <algorithm>
#include <vector>

#include "flank/path/half_space.h"
#include "flank/verify/stock/dexel_field.h"

namespace flank::internal::verify {

/// Lines stand for a cell each, but beside a plane of the blank that leads along them: there the last line that holds material
/// stands for all up to the plane, which is half a cell to one and a half. All lines beside such a plane are at one distance from
/// it, so what one of them would count too much all of them would. Immutable.
class LineWeights {
 public:
  LineWeights(const DexelField& field, const Box3& box, const std::vector<HalfSpace>& planes, double cell_mm);

  /// Of a line between two places along it, in the mean, cells.
  [[nodiscard]] double between(const DexelField& field, int row, int line, double low, double high) const {
    double weight = 1.0;
    for (const Edge& edge : edges_) {
      const double room = edge.room - edge.across * field.place_across(line) - edge.up * field.place_up(row);
      const double a = room - edge.along * low, b = room - edge.along * high;
      if (a < 1.0 || b < 1.0) weight *= of_last(std::min(a, b), std::max(a, b));
    }
    return weight;
  }

 private:
  /// The plane's distance in the direction across the lines that it is the more square to, cells: linear in the place.
  struct Edge {
    double room = 0.0, along = 0.0, across = 0.0, up = 0.0;
  };
  /// In the mean over what is so far from the plane, cells: the last line where that is less than one.
  [[nodiscard]] static double of_last(double least, double most) {
    if (most < 1.0) return 0.5 + 0.5 * (least + most);
    const double last = (1.0 - least) / (most - least);
    return 1.0 + 0.5 * last * least;
  }
  std::vector<Edge> edges_;
};

}  // namespace flank::internal::verify
