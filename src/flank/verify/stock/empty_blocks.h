/// Blocks of a stock that are known to be empty: nothing is ever added to it, so they stay so.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "flank/verify/stock/dexel_field.h"

namespace flank::internal::verify {

/// Of one field, blocks of some cells each way, which are found by asking. Not for several threads at once.
class EmptyBlocks {
 public:
  explicit EmptyBlocks(const DexelField& field);
  /// The block that has a place as the lines around it see it; none beside the grid.
  [[nodiscard]] std::optional<std::size_t> block_at(const DexelField& field, const Vec3& x) const;
  [[nodiscard]] bool is_empty(std::size_t block) const { return asked_[block] == kEmpty; }
  /// Some place of a block has no material near. `margin`: how far beyond a block its lines must have none, mm.
  void add(const DexelField& field, std::size_t block, double margin);

 private:
  static constexpr std::uint8_t kEmpty = 255;
  [[nodiscard]] bool looks_empty(const DexelField& field, std::size_t block, double margin) const;
  int shift_ = 2;                    ///< a block has 2^shift_ cells each way
  std::array<int, 3> count_{};       ///< of blocks: across, up, along the lines
  std::vector<std::uint8_t> asked_;  ///< how often since the last look, or that it is empty
};

}  // namespace flank::internal::verify
