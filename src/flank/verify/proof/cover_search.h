/// How much of a face is surely touched: cell by cell, a ball of the path that comes near all places of a cell.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "flank/judge.h"
#include "flank/verify/proof/shape.h"

namespace flank::internal::verify {

struct CoverLimits {
  double tolerance_mm = 0.01;   ///< what is to be proved: f is at most this
  double gap_mm2 = 0.0;         ///< cells are cut until no more area than this is open
  std::size_t evaluations = 0;  ///< parts of cells looked at, at most about so many
  std::size_t cells = 0;        ///< held at once, at most about so many
};

struct ProvedCover {
  /// Of each sample's cell: no more area than this has f > tolerance, mm^2, at most the sample's own area.
  std::vector<double> open_mm2;
  std::size_t evaluations = 0;
};

/// `distances` are f of the samples, which need cells. Only material left is asked for: cuts are the matter of
/// search_depth. Parallel; the same bits for any number of threads.
[[nodiscard]] ProvedCover search_cover(const SweptVolume& volume, const Shape& shape, const FaceSamples& samples,
                                       std::span<const SweptDistance> distances, const CoverLimits& limits);

}  // namespace flank::internal::verify
