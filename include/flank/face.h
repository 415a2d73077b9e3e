/// A face of a part as values: a B-spline surface with its trims. What io reads, surface turns into a Target, verify
/// samples.
#pragma once

#include <string>
#include <vector>

#include "flank/bspline_curve.h"
#include "flank/bspline_surface.h"

namespace flank {

/// A closed loop of trimming curves in the parameter plane (u, v), end to start; holes and outer loops alike (even-odd
/// rule).
struct TrimLoop {
  std::vector<BSplineCurve2> edges;
};

struct Face {
  std::string id;  ///< "F" + 1-based index in the order of the file
  BSplineSurface surface;
  std::vector<TrimLoop> loops;  ///< empty: the whole parameter rectangle of the surface
  /// The unit normal that points away from the solid's material is sign * (S_u x S_v) / |S_u x S_v|, sign = reversed ?
  /// -1 : +1.
  bool reversed = false;
  bool of_solid = false;  ///< false: an open sheet, whose normal says nothing about where the material is
  int solid = -1;         ///< 0-based index of the solid it belongs to, -1 for a sheet
};

}  // namespace flank
