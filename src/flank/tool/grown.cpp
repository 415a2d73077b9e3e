#include "flank/tool/grown.h"

#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

namespace flank::internal {
namespace {

/// Whether a parameter, by its name, is a radius that grows with every sphere: an arc keeps its centre.
bool grows(std::string_view name) { return name == "radius" || name == "end_radius" || name == "arc"; }

RadialFunction as_spline(const RadialFunction& radial, double mm) {
  constexpr int kCoefficients = 240, kSamples = 4 * kCoefficients;
  std::vector<Vec2> samples;
  for (int k = 0; k <= kSamples; ++k) {
    const double s = radial.axis_length() * k / kSamples;
    samples.emplace_back(s, radial.at(s).r + mm);
  }
  return RadialFunction::spline_through(radial.axis_length(), samples, kCoefficients);
}

}  // namespace

RadialFunction grown(const RadialFunction& radial, double mm) {
  Eigen::VectorXd parameters = radial.parameters();
  const std::span<const std::string_view> names = parameter_names(radial.family());
  if (names.empty()) parameters.array() += mm;  // a spline's coefficients
  if (!names.empty() && std::none_of(names.begin(), names.end(), grows)) return as_spline(radial, mm);
  for (std::size_t k = 0; k < names.size(); ++k)
    if (grows(names[k])) parameters[static_cast<Eigen::Index>(k)] += mm;
  return radial.with_parameters(parameters);
}

Tool grown(const Tool& tool, double mm) {
  Tool out = tool;
  out.radial = grown(tool.radial, mm);
  return out;
}

}  // namespace flank::internal
