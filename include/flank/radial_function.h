/// Radial function r(s): radius of the inscribed sphere centred at arc length s of the axis, s = 0 the tip, s = L
/// towards the holder.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "flank/vec.h"

namespace flank {

/// r, r', r'' at one s.
struct RadialJet {
  double r = 0.0, d1 = 0.0, d2 = 0.0;
};

/// The families and their parameters, in order (mm; angles in radians; x = s - L/2, the distance from mid-length):
///   cylinder        radius               r = radius: a cylinder with spherical ends
///   cone            radius, angle        r = radius + s sin(angle): meridian slope `angle`, inscribed sphere `radius` at s = 0
///   barrel          arc, radius, s0      r = arc - sqrt((arc - radius)^2 + (s - s0)^2): meridian arc of radius `arc`, largest
///                                        `radius` at s0. arc < 0 is a concave arc of radius |arc| with waist `radius`;
///                                        0 < arc < radius is the outer side of a torus, which is no tool (B, Example 1;
///                                        check_legitimacy says so)
///   lens            radius, end_radius   barrel arc symmetric about mid-length: `radius` there, `end_radius` at both ends
///   tapered-barrel  arc, radius, angle   barrel arc tilted by `angle`: inscribed sphere `radius` at x = 0 and meridian slope
///                                        `angle` there (another reference point would only name the same arc twice)
///   hyperbolic      radius, slope, bend  r = radius + slope x + bend x^2; bend > 0 (1/mm) is a concave meridian
///   power           a, b, c, d           r = (a + b s)^(1/d) / c (B (19); one parameter more than degrees of freedom)
///   spline          coefficients         clamped cubic B-spline over [0, L] with equal knots
enum class ToolFamily { kCylinder, kCone, kBarrel, kLens, kTaperedBarrel, kHyperbolic, kPower, kSpline };

/// Value type; cheap to evaluate, no allocation in at() and gradient().
class RadialFunction {
 public:
  RadialFunction() = default;
  /// Family with its parameters in the order of parameter_names(family); lengths in mm, angles in radians.
  /// Throws InternalError if their number or the length (finite, > 0) is wrong; what they describe is judged by
  /// check_legitimacy.
  RadialFunction(ToolFamily family, double axis_length, Eigen::VectorXd parameters);
  /// Clamped cubic B-spline over [0, L] with equal knots; the coefficients are the parameters (at least 4).
  [[nodiscard]] static RadialFunction spline(double axis_length, Eigen::VectorXd coefficients);
  /// Least-squares spline of `count` (at least 4) coefficients through samples (s, r), in any order. Exact to round-off
  /// when the samples lie on such a spline; coefficients that no sample reaches continue their neighbours evenly.
  [[nodiscard]] static RadialFunction spline_through(double axis_length, std::span<const Vec2> samples, int count);

  /// r, r', r'' at s. Outside [0, L] the formula or the end polynomial goes on. NaN where the formula has no value.
  [[nodiscard]] RadialJet at(double s) const;
  /// dr/dparameter_k at s, into out[0 .. parameter_count()): exact derivatives.
  void gradient(double s, double* out) const;
  /// The same for the active ones only: out[j] = dr/dparameter_{first_active(s) + j}, j in [0, active_count()).
  void active_gradient(double s, double* out) const;
  /// For splines: index of the first of the four coefficients that act at s (others' gradients are zero); for families
  /// 0.
  [[nodiscard]] int first_active(double s) const;
  /// How many consecutive parameters may act at one s: 4 for splines, parameter_count() else.
  [[nodiscard]] int active_count() const;

  /// Smallest r over [0, L]. Exact to round-off, not sampled: the least of r at both ends, at the knots of a spline and
  /// at the zeros of r', which have a closed form for every knot span and every family. NaN if the formula has no value
  /// somewhere in [0, L]. Nothing is stored: a call takes a few evaluations per knot span.
  [[nodiscard]] double smallest() const;
  /// Largest r over [0, L], in the same way.
  [[nodiscard]] double largest() const;
  /// Largest |r'| over [0, L], in the same way with the zeros of r''.
  [[nodiscard]] double steepest() const;

  [[nodiscard]] ToolFamily family() const { return family_; }
  [[nodiscard]] double axis_length() const { return axis_length_; }
  [[nodiscard]] const Eigen::VectorXd& parameters() const { return parameters_; }
  [[nodiscard]] int parameter_count() const { return static_cast<int>(parameters_.size()); }
  [[nodiscard]] RadialFunction with_parameters(const Eigen::VectorXd& parameters) const;

 private:
  ToolFamily family_ = ToolFamily::kCylinder;
  double axis_length_ = 0.0;
  Eigen::VectorXd parameters_;
};

/// Every family, in the order of the enumeration.
inline constexpr std::array<ToolFamily, 8> kToolFamilies = {
    ToolFamily::kCylinder,      ToolFamily::kCone,       ToolFamily::kBarrel, ToolFamily::kLens,
    ToolFamily::kTaperedBarrel, ToolFamily::kHyperbolic, ToolFamily::kPower,  ToolFamily::kSpline};

/// "tapered-barrel": as files and the command line name it.
[[nodiscard]] std::string_view family_name(ToolFamily family);
/// The inverse; nothing for an unknown name.
[[nodiscard]] std::optional<ToolFamily> family_from_name(std::string_view name);
/// "cylinder, cone, ..., power": those that are given by named parameters.
[[nodiscard]] std::string tool_families();
/// Names of the parameters in order; empty for splines, whose coefficients have no names.
[[nodiscard]] std::span<const std::string_view> parameter_names(ToolFamily family);
/// Is parameter `index` of the family an angle in radians (else a length or a plain number)?
[[nodiscard]] bool parameter_is_angle(ToolFamily family, int index);

}  // namespace flank
