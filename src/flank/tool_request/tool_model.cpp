#include "flank/tool_request/tool_model.h"

#include <fmt/format.h>

#include "flank/error.h"
#include "flank/tool.h"
#include "flank/tool/families.h"

namespace flank::internal {
namespace {

/// The longest axis on which a given tool of a family is one; none: it never ends. mm
std::optional<double> end_of(const ToolModel& model) {
  constexpr double kForever = 1e6;
  constexpr int kHalvings = 60;
  const auto is_tool = [&](double length) { return check_legitimacy(model.make(length, 1.0)).legitimate; };
  if (is_tool(kForever)) return std::nullopt;
  double low = 0.0, high = kForever;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (is_tool(middle) ? low : high) = middle;
  }
  return low;
}

void limit_axis(const ToolSpec& spec, const std::optional<double>& axis_length_mm, ToolModel& model) {
  constexpr double kBeforeTheEnd = 0.95;  // nobody grinds a tool to where its radius ends
  if (has_open_parameters(spec)) return;
  const std::optional<double> end = end_of(model);
  if (!end) return;
  if (!(*end > 0.0)) throw UsageError("tool", check_legitimacy(model.make(1.0, 1.0)).reason);
  if (axis_length_mm && !check_legitimacy(model.make(*axis_length_mm, 1.0)).legitimate)
    throw UsageError("axis_length_mm", fmt::format("{}", *axis_length_mm),
                     fmt::format("is too long for such a tool; expected at most {:.4g} mm", *end));
  model.longest_axis = kBeforeTheEnd * *end;
  model.free_parameters.clear();  // a barrel's middle stays there, or it would end sooner on one side
}

}  // namespace

Eigen::VectorXd start_parameters(ToolFamily family, const std::map<std::string, double>& given, double axis_length,
                                 double radius) {
  const Family& row = row_of(family);
  if (row.typical == nullptr) throw UsageError("tool", "a spline has no parameters by name; use free, or a tool.json");
  const std::array<double, 4> typical = row.typical(axis_length, radius);
  Eigen::VectorXd parameters(static_cast<Eigen::Index>(row.count));
  for (std::size_t k = 0; k < row.count; ++k) {
    const auto found = given.find(std::string(row.parameters[k]));
    parameters[static_cast<Eigen::Index>(k)] = found != given.end() ? found->second : typical[k];
  }
  return parameters;
}

ToolModel make_tool_model(const ToolSpec& spec, const std::optional<double>& axis_length_mm) {
  ToolModel model;
  if (spec.tool) {
    const RadialFunction radial = spec.tool->radial;
    model.make = [radial](double, double) { return radial; };
    model.axis_length = radial.axis_length();
    double sum = 0.0;
    // The mean radius, at 21 places: what starts are laid out with.
    for (int j = 0; j <= 20; ++j) sum += radial.at(radial.axis_length() * j / 20.0).r / 21.0;
    model.radius = sum;
    return model;
  }
  if (!spec.family) return model;
  const ToolFamily family = *spec.family;
  model.make = [family, given = spec.given](double axis_length, double radius) {
    return RadialFunction(family, axis_length, start_parameters(family, given, axis_length, radius));
  };
  const auto names = parameter_names(family);
  for (std::size_t k = 0; k < names.size(); ++k)
    if (!spec.given.contains(std::string(names[k]))) model.free_parameters.push_back(static_cast<int>(k));
  const auto radius = spec.given.find("radius");
  if (radius != spec.given.end()) model.radius = radius->second;
  limit_axis(spec, axis_length_mm, model);
  return model;
}

}  // namespace flank::internal
