#include "flank/tool_choice/family_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "flank/base/assert.h"
#include "flank/seed/direction/direction_filter.h"
#include "flank/tool.h"
#include "flank/tool/families.h"

namespace flank::internal {
namespace {

constexpr double kRadiansPerDegree = 0.017453292519943295;
constexpr double kStraightest = 1e-6;  ///< 1/mm: an arc of a kilometre stands for a straight line
/// Thinnest tool: radius as a share of the axis. Five diameters of length, beyond which tools bend.
constexpr double kThinnest = 0.1;
/// Thickest tool: radius as a share of the target's diagonal. A thicker one seldom reaches; it costs little to look.
constexpr double kThickestShare = 0.15;
/// Widening of the range of the target's curvatures, so that the best tool is not at its edge. Also the least ratio of
/// the thickest to the thinnest radius: a range must not be empty.
constexpr double kMargin = 1.5;
/// Share of the target's places whose curvatures are left out at either end: corners and ripples of a spline must not
/// set the range.
constexpr double kQuantile = 0.05;
/// Levels of the grid. Curvature decides most, and its range goes through zero to both sides: an odd number has the
/// middle in it. At most 5 x 9 x 5 = 225 tools per axis length, screened by the meridian alone; the compass search goes
/// on from there.
constexpr int kRadiusLevels = 5, kCurvatureLevels = 9, kAngleLevels = 5;
/// What parameters are rounded to, so that they can be printed in full and bought or ground: mm, mm, degrees, no unit.
constexpr double kRadiusStepMm = 0.01, kEndRadiusStepMm = 1e-4, kAngleStepDegrees = 0.01, kSlopeStep = 1e-4;
/// Significant digits of an arc and of a bend, which range over many orders: 1e-4 of an arc changes the sagitta L^2 /
/// (8 arc) by 1e-4 of itself.
constexpr int kArcDigits = 4;

double rounded(double value, double step) { return std::round(value / step) * step; }

double to_digits(double value, int digits) {
  if (value == 0.0) return 0.0;
  const double step = std::pow(10.0, std::floor(std::log10(std::abs(value))) - digits + 1);
  return rounded(value, step);
}

/// The value below which `share` in [0, 1] of the values lie. At least one value.
double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

std::optional<FamilyCoordinate> coordinate_of(std::string_view name) {
  if (name == "radius") return FamilyCoordinate::kRadius;
  if (name == "arc" || name == "end_radius" || name == "bend") return FamilyCoordinate::kCurvature;
  if (name == "angle" || name == "slope") return FamilyCoordinate::kAngle;
  return std::nullopt;
}

/// Radius at the ends of a lens whose meridian has this curvature: from arc - radius = (l^2 - h^2) / (2 h), h the drop,
/// l half the axis. Solved for h in the form that loses no digits as the curvature goes to zero.
double lens_end(double radius, double curvature, double axis_length) {
  const double half = 0.5 * axis_length, k = curvature / (1.0 - radius * curvature);
  return radius - half * half * k / (1.0 + std::sqrt(1.0 + half * half * k * k));
}

}  // namespace

FamilyChart::FamilyChart(ToolFamily family, std::map<std::string, double> given, double axis_length,
                         const ScreenPlaces& places, double tolerance_mm)
    : family_(family), given_(std::move(given)), axis_length_(axis_length) {
  const Family& row = row_of(family_);
  if (row.middle >= 0) given_.emplace(row.parameters[static_cast<std::size_t>(row.middle)], 0.5 * axis_length_);
  for (const std::string_view name : parameter_names(family_)) {
    const auto coordinate = coordinate_of(name);
    if (coordinate && !given_.contains(std::string(name))) coordinates_.push_back(*coordinate);
  }
  radius_low_ = kThinnest * axis_length_;
  radius_high_ = std::max(kThickestShare * places.diagonal_mm, kMargin * radius_low_);
  std::vector<double> lower, upper;
  for (const Footpoint& foot : places.feet) {
    lower.push_back(foot.k1);
    upper.push_back(foot.k2);
  }
  // The curvature that the filter counts as one tolerance of error over this axis (direction_filter.h).
  curvature_unit_ = kParabolaShare * tolerance_mm / (axis_length_ * axis_length_);
  curvature_low_ = std::min(-curvature_unit_, kMargin * quantile(lower, kQuantile));
  curvature_high_ = std::max(curvature_unit_, kMargin * quantile(upper, 1.0 - kQuantile));
  angle_low_ = row.angle_low;
  angle_high_ = row.angle_high;
}

/// A family has an angle or a slope, which is its sine.
bool FamilyChart::by_slope() const { return row_of(family_).angle < 0; }

int FamilyChart::levels(std::size_t coordinate) const {
  switch (coordinates_[coordinate]) {
    case FamilyCoordinate::kRadius:
      return kRadiusLevels;
    case FamilyCoordinate::kCurvature:
      return kCurvatureLevels;
    case FamilyCoordinate::kAngle:
      return kAngleLevels;
  }
  return 1;
}

double FamilyChart::value(FamilyCoordinate coordinate, double x) const {
  switch (coordinate) {
    case FamilyCoordinate::kRadius:
      return rounded(radius_low_ * std::pow(radius_high_ / radius_low_, x), kRadiusStepMm);
    case FamilyCoordinate::kCurvature: {
      // asinh is linear about zero, where a tolerance's worth of curvature is a different tool, and a logarithm far
      // from it.
      const double low = std::asinh(curvature_low_ / curvature_unit_),
                   high = std::asinh(curvature_high_ / curvature_unit_);
      const double curvature = curvature_unit_ * std::sinh(low + x * (high - low));
      return std::abs(curvature) < kStraightest ? kStraightest : curvature;
    }
    case FamilyCoordinate::kAngle:
      return angle_low_ + x * (angle_high_ - angle_low_);
  }
  return 0.0;
}

std::optional<RadialFunction> FamilyChart::at(const std::vector<double>& x) const {
  FLANK_ASSERT(x.size() == coordinates_.size());
  std::map<std::string, double> parameters = given_;
  double curvature = 0.0;
  for (std::size_t k = 0; k < coordinates_.size(); ++k) {
    const double here = value(coordinates_[k], x[k]);
    if (coordinates_[k] == FamilyCoordinate::kRadius) parameters["radius"] = here;
    if (coordinates_[k] == FamilyCoordinate::kCurvature) curvature = here;
    if (coordinates_[k] != FamilyCoordinate::kAngle) continue;
    if (by_slope())
      parameters["slope"] = rounded(here, kSlopeStep);
    else
      parameters["angle"] = kRadiansPerDegree * rounded(here / kRadiansPerDegree, kAngleStepDegrees);
  }
  const double radius = parameters.at("radius");
  if (radius * curvature >= 1.0) return std::nullopt;  // the arc would be smaller than the tool
  parameters.emplace("arc", to_digits(curvature == 0.0 ? 1.0 / kStraightest : 1.0 / curvature, kArcDigits));
  parameters.emplace("end_radius", rounded(lens_end(radius, curvature, axis_length_), kEndRadiusStepMm));
  const double slope = parameters.contains("slope") ? parameters.at("slope") : 0.0;
  // r = radius + slope x + bend x^2, so r'' = 2 bend; r'' / (1 - r'^2) = -kappa / (1 - r kappa) (MATH section 1).
  parameters.emplace("bend",
                     to_digits(-0.5 * curvature * (1.0 - slope * slope) / (1.0 - radius * curvature), kArcDigits));
  const auto names = parameter_names(family_);
  Eigen::VectorXd values(static_cast<Eigen::Index>(names.size()));
  for (std::size_t k = 0; k < names.size(); ++k)
    values[static_cast<Eigen::Index>(k)] = parameters.at(std::string(names[k]));
  const RadialFunction radial(family_, axis_length_, values);
  return check_legitimacy(radial).legitimate ? std::optional(radial) : std::nullopt;
}

std::string FamilyChart::text() const {
  std::vector<std::string> parts;
  for (const FamilyCoordinate coordinate : coordinates_) {
    if (coordinate == FamilyCoordinate::kRadius)
      parts.push_back(fmt::format("radius from a tenth of the axis length to {:.3g} mm", radius_high_));
    if (coordinate == FamilyCoordinate::kCurvature)
      parts.push_back(fmt::format("arc from {:.3g} mm (concave) through straight to {:.3g} mm", 1.0 / curvature_low_,
                                  1.0 / curvature_high_));
    if (coordinate == FamilyCoordinate::kAngle && by_slope())
      parts.push_back(fmt::format("slope {:.3g} to {:.3g}", angle_low_, angle_high_));
    if (coordinate == FamilyCoordinate::kAngle && !by_slope())
      parts.push_back(fmt::format("angle {:.3g} to {:.3g} degrees", angle_low_ / kRadiansPerDegree,
                                  angle_high_ / kRadiansPerDegree));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string family_text(const RadialFunction& radial) {
  std::vector<std::string> parts;
  const auto names = parameter_names(radial.family());
  for (std::size_t k = 0; k < names.size(); ++k) {
    const bool angle = parameter_is_angle(radial.family(), static_cast<int>(k));
    const double value = radial.parameters()[static_cast<Eigen::Index>(k)] / (angle ? kRadiansPerDegree : 1.0);
    if (static_cast<int>(k) == row_of(radial.family()).middle && value == 0.5 * radial.axis_length()) continue;
    parts.push_back(fmt::format("{}={:.6g}", names[k], value));
  }
  return fmt::format("{}:{}", family_name(radial.family()), fmt::join(parts, ","));
}

}  // namespace flank::internal
