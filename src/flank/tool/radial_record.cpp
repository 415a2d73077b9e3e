#include "flank/tool/radial_record.h"

namespace flank::internal {

void code(StepCodec& codec, RadialFunction& radial) {
  ToolFamily family = radial.family();
  double length = radial.axis_length();
  std::vector<double> parameters(radial.parameters().begin(), radial.parameters().end());
  code_choice(codec, family, static_cast<int>(kToolFamilies.size()));
  codec.finite(length);
  code(codec, parameters);
  for (double& parameter : parameters) codec.require(parameter - parameter == 0.0, "expected finite parameters");
  const bool empty = length == 0.0 && parameters.empty();
  constexpr std::size_t kLeastCoefficients = 4;
  const bool counted = family == ToolFamily::kSpline ? parameters.size() >= kLeastCoefficients
                                                     : parameters.size() == parameter_names(family).size();
  codec.require(empty || (length > 0.0 && counted), "expected a family with its parameters and a length > 0");
  if (!codec.reading()) return;
  const Eigen::Map<const Eigen::VectorXd> all(parameters.data(), static_cast<Eigen::Index>(parameters.size()));
  radial = empty ? RadialFunction() : RadialFunction(family, length, all);
}

void code(StepCodec& codec, Tool& tool) {
  code(codec, tool.radial);
  for (std::vector<Vec2>* profile : {&tool.shank, &tool.holder}) {
    std::size_t points = profile->size();
    code(codec, points);
    for (Vec2& point : *profile)
      for (double& coordinate : point) codec.number(coordinate);
  }
}

}  // namespace flank::internal
