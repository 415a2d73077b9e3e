/// Convex quadratic step under linear limits: minimise 1/2 x'Hx + g'x subject to J_k x + c_k >= 0, with H and J as the
/// fit has them (an arrow, and rows of four control points).
#pragma once

#include <vector>

#include "flank/fit/solver/arrow_system.h"

namespace flank::internal {

struct GapProblem {
  const ArrowSystem* quadratic = nullptr;  ///< H and g; H positive definite (add_damping); not owned
  std::vector<ResidualRow> rows;           ///< J, one row per limit
  std::vector<double> gaps;                ///< c, mm, one per row; negative: violated now, the step is to mend it
};

/// The step x, in the order of the system's unknowns, by primal-dual path following with slacks (fixed centring, step
/// to the boundary as in Mehrotra 1992). Ends when the complementarity has fallen by 1e-8 or after `iterations`. If the
/// limits contradict each other, or a factorisation fails, it returns the last x: check the gaps after the step.
/// Without limits this is one Newton step.
[[nodiscard]] Eigen::VectorXd solve_gaps(const GapProblem& problem, int iterations);

}  // namespace flank::internal
