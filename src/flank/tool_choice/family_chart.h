/// A family of tools as a space to search: the parameters that are open, as coordinates in [0, 1] over what suits a
/// target (docs/algorithms/catalogue.md).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "flank/radial_function.h"
#include "flank/tool_choice/tool_screen.h"

namespace flank::internal {

/// What a coordinate stands for. Every family has at most one of each.
enum class FamilyCoordinate {
  kRadius,     ///< `radius`, mm, in its logarithm
  kCurvature,  ///< of the meridian, 1/arc (`arc`, `end_radius`, `bend`): asinh of it over what the tolerance sees
  kAngle       ///< `angle`, or `slope` as its sine
};

/// The space of one family with one axis length. Values of a coordinate: low at 0, high at 1. Coordinates are chosen so
/// that equal steps are about equally different tools: radii by ratio, curvatures by what the tolerance can tell apart.
/// Immutable.
class FamilyChart {
 public:
  /// `given`: names of parameter_names(family), mm and radians. What is the middle of the axis in a family's row need not be given.
  /// Radii reach from a tenth of the axis (five diameters long) to 15 hundredths of the target's diagonal, curvatures
  /// over those of the target, angles as the family's row says (families.h).
  FamilyChart(ToolFamily family, std::map<std::string, double> given, double axis_length, const ScreenPlaces& places,
              double tolerance_mm);

  /// The open parameters, in the order of the family's names; empty if all are given.
  [[nodiscard]] const std::vector<FamilyCoordinate>& coordinates() const { return coordinates_; }
  /// Grid levels of a coordinate that see every different tool, roughly; >= 2.
  [[nodiscard]] int levels(std::size_t coordinate) const;
  /// The tool at x in [0, 1]^n, its parameters rounded: radii to 0.01 mm, arcs to four digits, angles to 0.01 degrees.
  /// Nothing if that is no legitimate tool (MATH section 1). Rounded, so that what is printed is what was tried.
  [[nodiscard]] std::optional<RadialFunction> at(const std::vector<double>& x) const;
  /// "radius from a tenth of the axis length to 13.2 mm, arc from -31.2 mm (concave) over straight to 45.6 mm".
  [[nodiscard]] std::string text() const;

 private:
  [[nodiscard]] double value(FamilyCoordinate coordinate, double x) const;
  [[nodiscard]] bool by_slope() const;

  ToolFamily family_;
  std::map<std::string, double> given_;
  double axis_length_ = 0.0;
  std::vector<FamilyCoordinate> coordinates_;
  double radius_low_ = 0.0, radius_high_ = 0.0;        ///< mm
  double curvature_low_ = 0.0, curvature_high_ = 0.0;  ///< 1/mm, positive: the tool bulges
  double curvature_unit_ = 0.0;                        ///< 1/mm: what the tolerance sees along this axis
  double angle_low_ = 0.0, angle_high_ = 0.0;
};

/// "barrel:arc=85,radius=5": as a request for a tool names it; angles in degrees.
[[nodiscard]] std::string family_text(const RadialFunction& radial);

}  // namespace flank::internal
