/// From what the user says of the tool to what the fit may change of it.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "flank/fit.h"
#include "flank/tool_request/tool_spec.h"

namespace flank::internal {

/// The family's parameters: the given ones, and for the others a start value of a tool with this axis length and
/// typical radius (mm).
[[nodiscard]] Eigen::VectorXd start_parameters(ToolFamily family, const std::map<std::string, double>& given,
                                               double axis_length, double radius);

/// `free`: a spline; a family: its parameters that are not given are free; a tool file: fixed.
/// What ends somewhere (a barrel of given arc and radius) takes part of a longer contact line. Throws UsageError of
/// `axis_length_mm` if that is given and beyond the end.
[[nodiscard]] ToolModel make_tool_model(const ToolSpec& spec, const std::optional<double>& axis_length_mm);

}  // namespace flank::internal
