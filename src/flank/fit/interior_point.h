/// Convex quadratic step under linear gaps: minimise 1/2 x'Hx + g'x subject to A x + c >= 0, with H and A as the fit
/// has them.
#pragma once

#include <vector>

#include "flank/fit/fit_model.h"

namespace flank {

struct GapProblem {
  const FitModel* model = nullptr;
  const FitState* rows = nullptr;          ///< state whose footpoints give the rows of A
  const ArrowSystem* quadratic = nullptr;  ///< H and g
  std::vector<std::vector<double>> gaps;   ///< c, [motion][sample]
};

/// Primal-dual path following (Mehrotra's step to the boundary, fixed centring). Returns the best step found.
[[nodiscard]] Eigen::VectorXd solve_gaps(const GapProblem& problem, int iterations);

}  // namespace flank
