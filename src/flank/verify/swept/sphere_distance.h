/// Distance from a point of the tool plane to one sphere of the tool, and which sphere near a given one is the nearest.
#pragma once

#include <cmath>

#include "flank/verify/swept/radial_table.h"

namespace flank::internal::verify {

/// sqrt((z - s)^2 + rho^2) - r(s), mm.
[[nodiscard]] inline double sphere_distance(const RadialTable& radial, double z, double rho, double s) {
  return std::sqrt((z - s) * (z - s) + rho * rho) - radial.at(s).r;
}

/// Newton's method on s, in [0, L], towards a minimum of sphere_distance; false if it does not converge (s is of no use
/// then). Ends with a step below 1e-6 mm; what is left of the value is its square.
[[nodiscard]] bool polish_sphere(const RadialTable& radial, double z, double rho, double& s);

}  // namespace flank::internal::verify
