/// Blocks of a stock that are known to be empty: nothing is ever added to it, so they stay so.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "flank/verify/stock/dexel_field.h"

namespace flank::internal::verify {

/// Of one field, cubes of some cells each way, which are found by asking. Not for several threads at once.
class EmptyBlocks {
 public:
  explicit EmptyBlocks(const DexelField& field);
  /// The block that has a place; none beside the grid.
  [[nodiscard]] std::optional<std::size_t> block_at(const Vec3& x) const {
    const Vec3 from = per_mm_ * (x - low_);
    if (!(from.x() >= 0.0 && from.y() >= 0.0 && from.z() >= 0.0)) return std::nullopt;
    if (!(from.x() < count_[0] && from.y() < count_[1] && from.z() < count_[2])) return std::nullopt;
    const auto at = [&](int k) { return static_cast<std::size_t>(static_cast<int>(from[k])); };
    return (at(2) * static_cast<std::size_t>(count_[1]) + at(1)) * static_cast<std::size_t>(count_[0]) + at(0);
  }
  [[nodiscard]] bool is_empty(std::size_t block) const { return asked_[block] == kEmpty; }
  /// Some place of a block has no material near. `margin`: how far beyond a block its lines must have none, mm.
  void add(const DexelField& field, std::size_t block, double margin);

 private:
  static constexpr std::uint8_t kEmpty = 255;
  [[nodiscard]] bool looks_empty(const DexelField& field, std::size_t block, double margin) const;
  int cells_ = 4;                    ///< of a block, each way
  double per_mm_ = 0.0;              ///< blocks
  Vec3 low_;                         ///< where the grid begins
  std::array<int, 3> count_{};       ///< of blocks along x, y, z
  std::vector<std::uint8_t> asked_;  ///< how often since the last look, or that it is empty
};

}  // namespace flank::internal::verify
