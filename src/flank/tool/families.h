/// The families of tools, a row each: whatever differs between them stands here.
#pragma once

#include <array>
#include <numbers>

#include "flank/radial_function.h"

namespace flank::internal {

/// A family. L is the length of the axis, p are its parameters in the order of `parameters`; mm and radians.
struct Family {
  std::string_view name;  ///< of files and of the command line
  std::array<std::string_view, 4>
      parameters{};  ///< the first `count` of them; the names say what they are (family_chart.h)
  std::size_t count = 0;
  int angle = -1;   ///< index of the parameter that is an angle, -1 for none
  int middle = -1;  ///< index of the parameter that is the middle of the axis unless it is given, -1 for none
  /// What a search tries of `angle`, or of `slope` (dr/ds). No limits of mathematics (any |r'| < 1 is a tool): wider than tools
  /// that are sold, and a compass search that ended at its edge, when cones went to 10 degrees only, found less.
  double angle_low = 0.0, angle_high = 0.0;

  /// r, r', r'' at s; null: a spline, which has no closed form.
  RadialJet (*jet)(double L, const double* p, double s) = nullptr;
  /// dr/dparameter_k into out.
  void (*gradient)(double L, const double* p, double s, double* out) = nullptr;
  /// The only s, inside [0, L] or not, at which r' changes its sign; null, or NaN, if there is none. No family's r'' changes its
  /// sign, so that r' is steepest at one of the ends.
  double (*turning_point)(double L, const double* p) = nullptr;
  /// Parameters of a tool about as thick as `radius` (mm), with a little of what makes its family: where that is nothing,
  /// several parameters (a, c and d of a power tool) change the radius alone, and a fit cannot tell them apart.
  std::array<double, 4> (*typical)(double L, double radius) = nullptr;
};

/// In the order of ToolFamily.
extern const std::array<Family, kToolFamilies.size()> kFamilies;

[[nodiscard]] inline const Family& row_of(ToolFamily family) { return kFamilies[static_cast<std::size_t>(family)]; }

inline constexpr double kMostConeAngle = 20.0 * std::numbers::pi / 180.0;   ///< of the meridian to the axis, rad
inline constexpr double kMostTaperAngle = 40.0 * std::numbers::pi / 180.0;  ///< of a tilted arc, rad
inline constexpr double kMostSlope = 0.2;                                   ///< dr/ds, either way

}  // namespace flank::internal
