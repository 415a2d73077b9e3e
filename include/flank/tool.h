/// A tool: radial function of the cutting flank, shank and holder above it; legitimacy; the meridian.
///
/// A tool is legitimate if the spheres of its axis are inscribed in its flank: r > 0, |r'| < 1 and 1 - r'^2 - r r'' > 0 for
/// every s (MATH section 1). Then its meridian is a curve without corners, and it can be ground. Nothing here assumes that:
/// check_legitimacy() says whether, and where not. Lengths in mm; s runs from the tip to the upper end, z with it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/radial_function.h"

namespace flank {

struct Tool {
  RadialFunction radial;
  std::string name;
  std::vector<Vec2> shank;   ///< profile (z, radius) above s = L, z along the axis from s = 0; may be empty
  std::vector<Vec2> holder;  ///< likewise
};

/// Why a radial function is not a tool (MATH section 1): r > 0, |r'| < 1, 1 - r'^2 - r r'' > 0. First violation along
/// s.
struct Legitimacy {
  bool legitimate = true;
  double s = 0.0;       ///< where it is violated, or where the margin is smallest
  double margin = 0.0;  ///< smallest of r / L, 1 - |r'| and 1 - r'^2 - r r''
  std::string reason;   ///< one clear sentence, empty if legitimate
};
[[nodiscard]] Legitimacy check_legitimacy(const RadialFunction& radial);

/// How a tool bends under a force across its tip: an elastic beam of the inscribed spheres' radii and the shank, clamped
/// where its holder begins, without a holder at its upper end.
struct Stiffness {
  double length_mm = 0.0;               ///< from the tip to where it is clamped
  double equivalent_diameter_mm = 0.0;  ///< of the cylinder of this length that bends as much
  double slenderness = 0.0;             ///< length over that diameter, lambda
  double deflection_um = 0.0;           ///< of the tip under kStiffnessForce, in cemented carbide
};
inline constexpr double kStiffnessForce = 100.0;  ///< N
/// Elastic modulus of cemented carbide, N/mm^2.
inline constexpr double kCarbideModulus = 6e5;
/// Infinite slenderness and deflection if the radius is not positive everywhere.
[[nodiscard]] Stiffness stiffness(const Tool& tool);

/// Of the radius at the flank's upper end: a thinner rod above it holds no tool.
inline constexpr double kRodShare = 0.1;

/// Meridian point (z, rho) of s: (s - r r', r sqrt(1 - r'^2)).
[[nodiscard]] Vec2 meridian_point(const RadialFunction& radial, double s);
/// Meridian polyline at `count` equal steps of s.
[[nodiscard]] std::vector<Vec2> meridian(const RadialFunction& radial, int count);

}  // namespace flank
