/// The deepest cut of a face, proved: branch and bound over cells of a shape.
#pragma once

#include <cstddef>

#include "flank/judge.h"
#include "flank/verify/proof/shape.h"

namespace flank::internal::verify {

struct DepthLimits {
  double tolerance_mm = 0.01;  ///< what is to be proved: nothing is cut deeper
  double gap_mm = 0.0;  ///< how near the bound is to come to the deepest place that was found, if it costs little
  std::size_t evaluations = 0;  ///< of f, at most about so many
  std::size_t cells = 0;        ///< held at once, at most about so many
};

struct ProvedDepth {
  double deepest_mm = 0.0;  ///< found, >= 0
  double bound_mm = 0.0;    ///< nothing of the shape is cut deeper
  SweptDistance place;      ///< strip -1: no cut was found
  Vec3 point = Vec3::Zero();
  Vec3 open_point = Vec3::Zero();  ///< about where the bound is
  double open_reach_mm = 0.0;      ///< how large the cell of the bound is
  std::size_t evaluations = 0;
  bool exhausted = false;  ///< a limit was met before the tolerance was proved or a deeper place was found
};

/// `found_mm` is a depth that is already known, `least_radius_mm` the tool's. Parallel; the same bits for any number of threads.
[[nodiscard]] ProvedDepth search_depth(const SweptVolume& volume, double least_radius_mm, const Shape& shape,
                                       double found_mm, const DepthLimits& limits);

}  // namespace flank::internal::verify
