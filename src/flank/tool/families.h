/// Value and derivatives of the radial functions that have a closed form. Used by RadialFunction only.
#pragma once

#include "flank/radial_function.h"

namespace flank::internal {

/// r, r', r'' of a family (not the spline) with parameters p (parameter_names(family) many) and axis length L.
[[nodiscard]] RadialJet family_jet(ToolFamily family, double axis_length, const double* p, double s);
/// dr/dparameter_k into out.
void family_gradient(ToolFamily family, double axis_length, const double* p, double s, double* out);

}  // namespace flank::internal
