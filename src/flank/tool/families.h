/// Value and derivatives of the radial functions that have a closed form. Used by RadialFunction only.
#pragma once

#include "flank/radial_function.h"

namespace flank::internal {

/// r, r', r'' of a family (not the spline) with parameters p (parameter_names(family) many) and axis length L.
[[nodiscard]] RadialJet family_jet(ToolFamily family, double axis_length, const double* p, double s);
/// dr/dparameter_k into out.
void family_gradient(ToolFamily family, double axis_length, const double* p, double s, double* out);
/// The only s, inside [0, L] or not, at which r' of a family changes its sign; NaN if there is none. No family's r''
/// changes its sign, so that r' is steepest at one of the ends.
[[nodiscard]] double family_turning_point(ToolFamily family, double axis_length, const double* p);

}  // namespace flank::internal
