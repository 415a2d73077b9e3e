#include "flank/verify/stock/empty_blocks.h"

#include <algorithm>

namespace flank::internal::verify {
namespace {

/// A fine grid has larger ones than the usual one.
constexpr std::size_t kMostBlocks = std::size_t{1} << 22U;
/// A block is looked at after so many places of it that had no material near.
constexpr std::uint8_t kOften = 6;
/// Of a cell: what rounding may do to where a block begins along its lines.
constexpr double kSpare = 1e-6;

}  // namespace

EmptyBlocks::EmptyBlocks(const DexelField& field) {
  std::array<int, 3> cells{};
  cells[static_cast<std::size_t>(field.across())] = field.width();
  cells[static_cast<std::size_t>(field.up())] = field.rows();
  cells[static_cast<std::size_t>(field.axis())] = field.depth();
  const auto all = [&] {
    std::size_t product = 1;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      count_[k] = (cells[k] + cells_ - 1) / cells_;
      product *= static_cast<std::size_t>(count_[k]);
    }
    return product;
  };
  while (all() > kMostBlocks) cells_ *= 2;
  asked_.assign(all(), 0);
  per_mm_ = 1.0 / (cells_ * field.cell());
  low_ = field.low();
}

void EmptyBlocks::add(const DexelField& field, std::size_t block, double margin) {
  if (asked_[block] == kEmpty || ++asked_[block] < kOften) return;
  asked_[block] = looks_empty(field, block, margin) ? kEmpty : 0;
}

bool EmptyBlocks::looks_empty(const DexelField& field, std::size_t block, double margin) const {
  const auto nx = static_cast<std::size_t>(count_[0]), ny = static_cast<std::size_t>(count_[1]);
  const std::array<int, 3> first = {static_cast<int>(block % nx) * cells_, static_cast<int>(block / nx % ny) * cells_,
                                    static_cast<int>(block / nx / ny) * cells_};
  const auto at = [&](int axis) { return first[static_cast<std::size_t>(axis)]; };
  const double more = margin + kSpare * field.cell(),
               from = field.low()[field.axis()] + at(field.axis()) * field.cell(), low = from - more,
               high = from + cells_ * field.cell() + more;
  // A place lies between two lines and two rows, which go through the middles of cells.
  const int line_low = std::max(0, at(field.across()) - 1), row_low = std::max(0, at(field.up()) - 1);
  const int line_high = std::min(at(field.across()) + cells_, field.width() - 1);
  const int row_high = std::min(at(field.up()) + cells_, field.rows() - 1);
  for (int row = row_low; row <= row_high; ++row)
    for (int line = line_low; line <= line_high; ++line) {
      double begin = low, end = high;
      if (field.meets(row, line, begin, end)) return false;
    }
  return true;
}

}  // namespace flank::internal::verify
