#include "flank/tool_request/tool_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <vector>

#include "flank/error.h"
#include "flank/io/text/json_input.h"
#include "flank/io/tool/read_any_tool.h"
#include "flank/tool/families.h"

namespace flank::internal {

namespace {

constexpr double kRadiansPerDegree = 0.017453292519943295;

/// A spelling on the command line: capitals, blanks and underscores are no difference.
std::string normalised(std::string name) {
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (c == '_' || c == ' ') c = '-';
  }
  return name;
}

/// What a family's parameters are called on the command line, for messages.
std::string accepted_parameters(ToolFamily family) {
  std::vector<std::string> names;
  for (int k = 0; k < static_cast<int>(parameter_names(family).size()); ++k) {
    const std::string name(parameter_names(family)[static_cast<std::size_t>(k)]);
    names.push_back(parameter_is_angle(family, k) ? name + " (degrees)" : name);
    if (name == "radius") names.push_back("diameter");
    if (name == "end_radius") names.push_back("end_diameter");
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

/// All of the text; a plus in front is allowed, which from_chars refuses.
double parse_number(const std::string& text, const std::string& field, const std::string& place) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const char* begin = text.data() + (!text.empty() && text.front() == '+' ? 1 : 0);
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value))
    throw UsageError(field, place, fmt::format("\"{}\" is not a number", text));
  return value;
}

/// Sizes that must be positive whatever the others are; the rest is judged by the tool as a whole (make_tool).
bool is_plain_size(const std::string& name) { return name == "radius" || name == "end_radius"; }

}  // namespace

bool ToolSpec::complete() const { return family && given.size() == parameter_names(*family).size(); }

bool has_open_parameters(const ToolSpec& spec) {
  if (!spec.family) return false;
  const Family& row = row_of(*spec.family);
  for (std::size_t k = 0; k < row.count; ++k)
    if (static_cast<int>(k) != row.middle && !spec.given.contains(std::string(row.parameters[k]))) return true;
  return false;
}

std::pair<std::string, double> parse_tool_parameter(ToolFamily family, const std::string& text,
                                                    const std::string& field) {
  const std::size_t equals = text.find('=');
  const auto refuse = [&](const std::string& why) {
    return UsageError(field, text,
                      fmt::format("{}; a {} accepts {}", why, family_name(family), accepted_parameters(family)));
  };
  if (equals == std::string::npos) throw refuse("must be NAME=VALUE");
  const std::string asked = text.substr(0, equals);
  const double value = parse_number(text.substr(equals + 1), field, text);
  const auto names = parameter_names(family);
  for (int k = 0; k < static_cast<int>(names.size()); ++k) {
    const std::string name(names[static_cast<std::size_t>(k)]);
    // Makers state diameters: both names of a size are accepted.
    const std::string whole = name == "radius" ? "diameter" : name == "end_radius" ? "end_diameter" : "";
    if (normalised(asked) != normalised(name) && (whole.empty() || normalised(asked) != normalised(whole))) continue;
    const double size = normalised(asked) == normalised(name) ? value : 0.5 * value;
    if (is_plain_size(name) && !(size > 0.0)) throw UsageError(field, text, "must be > 0");
    if (!parameter_is_angle(family, k)) return {name, size};
    if (!(std::abs(value) < 90.0)) throw UsageError(field, text, "must lie between -90 and 90 degrees");
    return {name, value * kRadiansPerDegree};
  }
  throw refuse("unknown parameter");
}

ToolSpec parse_tool_spec(const std::string& text, const std::string& field) {
  ToolSpec spec;
  if (names_a_tool_file(text)) {
    ToolReading reading = read_any_tool(text);
    spec.tool = std::move(reading.tool);
    spec.notes = std::move(reading.notes);
    return spec;
  }
  const std::size_t colon = text.find(':');
  const std::string name = normalised(text.substr(0, colon));
  // A spline's coefficients are many, and a fit's business: by name it can only mean that the fit shall find them.
  if (name == "free" || name == "spline") {
    if (colon != std::string::npos) throw UsageError(field, text, "a free tool has no parameters");
    spec.free = true;
    return spec;
  }
  spec.family = family_from_name(name);
  if (!spec.family)
    throw UsageError(
        field, text,
        fmt::format("neither a family nor a tool file; accepted: free, {}, or a tool.json", tool_families()));
  if (colon == std::string::npos) return spec;
  // Up to and including the end: "cone:" and a comma at the end are an empty parameter, which is refused.
  for (std::size_t at = colon + 1; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const auto [key, value] = parse_tool_parameter(*spec.family, text.substr(at, end - at), field);
    if (!spec.given.emplace(key, value).second) throw UsageError(field, text, key + " is given twice");
    at = end + 1;
  }
  return spec;
}

Tool make_tool(ToolFamily family, const std::map<std::string, double>& parameters, double axis_length) {
  if (!(axis_length > 0.0 && std::isfinite(axis_length)))
    throw UsageError("axis_length_mm", fmt::format("is {}; must be a finite number > 0", axis_length));
  const auto names = parameter_names(family);
  if (names.empty())
    throw UsageError("a spline is given by its coefficients or samples in a tool.json, not by parameters");
  Eigen::VectorXd values(static_cast<Eigen::Index>(names.size()));
  std::vector<std::string> missing;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto found = parameters.find(std::string(names[k]));
    const bool middle = static_cast<int>(k) == row_of(family).middle;
    if (found == parameters.end() && !middle) missing.emplace_back(names[k]);
    values[static_cast<Eigen::Index>(k)] = found != parameters.end() ? found->second : 0.5 * axis_length;
  }
  if (!missing.empty())
    throw UsageError(fmt::format("{}: {} not given; its parameters are {}", family_name(family),
                                 fmt::join(missing, ", "), accepted_parameters(family)));
  for (const auto& [name, value] : parameters)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw UsageError(fmt::format("{}: unknown parameter {}; its parameters are {}", family_name(family), name,
                                   accepted_parameters(family)));
  Tool tool;
  tool.radial = RadialFunction(family, axis_length, values);
  // Parameters may each be fine and still make no tool, e.g. a barrel whose arc is smaller than its radius (MATH.md,
  // section 1).
  if (const Legitimacy verdict = check_legitimacy(tool.radial); !verdict.legitimate)
    throw UsageError(fmt::format("{}: not a tool, {}", family_name(family), verdict.reason));
  return tool;
}

Tool given_tool(const std::string& spec, std::optional<double> axis_length_mm, const std::string& not_free,
                std::vector<std::string>& notes) {
  const auto require = [](bool holds, const std::string& field, const std::string& text) {
    if (!holds) throw UsageError(field, text);
  };
  require(!spec.empty(), "tool", "expected a tool.json, or a family with all its parameters and `axis_length_mm`");
  const ToolSpec parsed = parse_tool_spec(spec);
  notes.insert(notes.end(), parsed.notes.begin(), parsed.notes.end());
  if (parsed.tool) {
    require(!axis_length_mm, "axis_length_mm", "the tool's file has its own; only for a family");
    const Legitimacy legitimacy = check_legitimacy(parsed.tool->radial);
    require(legitimacy.legitimate, "tool", spec + ": this is not a tool: " + legitimacy.reason);
    return *parsed.tool;
  }
  require(!parsed.free, "tool", not_free);
  require(axis_length_mm.has_value(), "axis_length_mm", "a family needs the length of its axis");
  return make_tool(*parsed.family, parsed.given, *axis_length_mm);
}

}  // namespace flank::internal
