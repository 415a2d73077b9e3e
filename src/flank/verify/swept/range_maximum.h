/// The largest of any run of numbers in a row, in constant time.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <utility>
#include <vector>

#include "flank/base/assert.h"

namespace flank::internal::verify {

/// Keeps the maxima of all runs whose length is a power of two: two of them cover any run.
class RangeMaximum {
 public:
  explicit RangeMaximum(std::vector<double> values) : levels_{std::move(values)} {
    for (std::size_t half = 1; 2 * half <= levels_.front().size(); half *= 2) {
      const std::vector<double>& below = levels_.back();
      std::vector<double> level(below.size() - half);
      for (std::size_t i = 0; i < level.size(); ++i) level[i] = std::max(below[i], below[i + half]);
      levels_.push_back(std::move(level));
    }
  }

  /// The largest of the values first to last, both included.
  [[nodiscard]] double over(std::size_t first, std::size_t last) const {
    FLANK_ASSERT(first <= last && last < levels_.front().size());
    const auto k = static_cast<std::size_t>(std::bit_width(last - first + 1) - 1);
    const std::vector<double>& level = levels_[k];
    return std::max(level[first], level[last + 1 - (std::size_t{1} << k)]);
  }
  [[nodiscard]] double over_all() const { return over(0, levels_.front().size() - 1); }

 private:
  std::vector<std::vector<double>> levels_;  ///< [k][i]: of 2^k values from i
};

}  // namespace flank::internal::verify
