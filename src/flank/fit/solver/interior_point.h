/// Convex quadratic step under linear gaps: minimise 1/2 x'Hx + g'x subject to J_k x + c_k >= 0, with H and J as the fit
/// has them.
#pragma once

#include <vector>

#include "flank/fit/solver/arrow_system.h"

namespace flank::internal {

struct GapProblem {
  const ArrowSystem* quadratic = nullptr;  ///< H and g
  std::vector<ResidualRow> rows;           ///< J
  std::vector<double> gaps;                ///< c
};

/// Primal-dual path following (Mehrotra's step to the boundary, fixed centring). Returns the best step found.
[[nodiscard]] Eigen::VectorXd solve_gaps(const GapProblem& problem, int iterations);

}  // namespace flank::internal
