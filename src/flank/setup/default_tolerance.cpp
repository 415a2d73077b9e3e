#include "flank/setup/default_tolerance.h"

#include <initializer_list>

namespace flank::internal {

double default_tolerance(double diagonal_mm) {
  constexpr double kShare = 1e-3, kLeast = 0.005;
  constexpr double kRounding = 1.0 + 1e-9;  // a diagonal of 100 mm that was computed is worth 0.1 mm, too
  for (const double step : {0.5, 0.2, 0.1, 0.05, 0.02, 0.01})
    if (step <= kShare * diagonal_mm * kRounding) return step;
  return kLeast;
}

}  // namespace flank::internal
