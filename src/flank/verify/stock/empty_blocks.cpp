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
  const auto all = [&] {
    const auto blocks_of = [&](int cells) { return ((cells - 1) >> shift_) + 1; };
    count_ = {blocks_of(field.width()), blocks_of(field.rows()), blocks_of(field.depth())};
    return static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) *
           static_cast<std::size_t>(count_[2]);
  };
  while (all() > kMostBlocks) ++shift_;
  asked_.assign(all(), 0);
}

std::optional<std::size_t> EmptyBlocks::block_at(const DexelField& field, const Vec3& x) const {
  const double line = field.line_at(x[field.across()]), row = field.row_at(x[field.up()]),
               place = field.cells_along(x[field.axis()]);
  if (!(line >= 0.0 && row >= 0.0 && place >= 0.0)) return std::nullopt;
  const int a = static_cast<int>(line) >> shift_, b = static_cast<int>(row) >> shift_,
            c = static_cast<int>(place) >> shift_;
  if (a >= count_[0] || b >= count_[1] || c >= count_[2]) return std::nullopt;
  return (static_cast<std::size_t>(b) * static_cast<std::size_t>(count_[0]) + static_cast<std::size_t>(a)) *
             static_cast<std::size_t>(count_[2]) +
         static_cast<std::size_t>(c);
}

void EmptyBlocks::add(const DexelField& field, std::size_t block, double margin) {
  if (asked_[block] == kEmpty || ++asked_[block] < kOften) return;
  asked_[block] = looks_empty(field, block, margin) ? kEmpty : 0;
}

bool EmptyBlocks::looks_empty(const DexelField& field, std::size_t block, double margin) const {
  const auto along = static_cast<std::size_t>(count_[2]), across = static_cast<std::size_t>(count_[0]);
  const int cells = 1 << shift_, c = static_cast<int>(block % along) * cells,
            a = static_cast<int>(block / along % across) * cells, b = static_cast<int>(block / along / across) * cells;
  const double more = margin + kSpare * field.cell(), low = field.place_along(c) - more,
               high = field.place_along(c + cells) + more;
  // A place lies between two lines and two rows.
  const int lines = std::min(a + cells, field.width() - 1), rows = std::min(b + cells, field.rows() - 1);
  for (int row = b; row <= rows; ++row)
    for (int line = a; line <= lines; ++line) {
      double from = low, to = high;
      if (field.meets(row, line, from, to)) return false;
    }
  return true;
}

}  // namespace flank::internal::verify
