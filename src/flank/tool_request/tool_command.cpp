#include "flank/tool_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "flank/base/atomic_file.h"
#include "flank/base/kept/read_files.h"
#include "flank/error.h"
#include "flank/io/text/json_input.h"
#include "flank/io/tool/read_any_tool.h"
#include "flank/io/tool/tool_dxf.h"
#include "flank/io/tool/tool_fctb.h"
#include "flank/io/tool/tool_step.h"
#include "flank/io/tool/tool_svg.h"
#include "flank/tool_file.h"
#include "flank/tool_request/tool_spec.h"

namespace flank {
using namespace internal;

namespace {

constexpr int kProfilePoints = 401;  // of the table: a step of 1/400 of the axis

/// Small letters, ASCII: ".STEP" is ".step" everywhere.
std::string ending_of(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return ending;
}

/// Meridian and radial function as a table.
std::string profile_csv(const RadialFunction& radial) {
  std::string text = "s,r,z,radius\n";
  for (int i = 0; i < kProfilePoints; ++i) {
    // The last one is the end itself, not what rounding makes of it.
    const double s = i + 1 == kProfilePoints ? radial.axis_length() : radial.axis_length() * i / (kProfilePoints - 1);
    const Vec2 p = meridian_point(radial, s);
    text += fmt::format("{},{},{},{}\n", exact_number(s), exact_number(radial.at(s).r), exact_number(p.x()),
                        exact_number(p.y()));
  }
  return text;
}

}  // namespace

Tool tool_of_command(const ToolCommandOptions& options) {
  std::vector<std::string> notes;
  return tool_of_command(options, notes);
}

Tool tool_of_command(const ToolCommandOptions& options, std::vector<std::string>& notes) {
  for (const auto& [value, field] :
       {std::pair(options.axis_length_mm, "axis_length_mm"), std::pair(options.shank_diameter_mm, "shank_diameter_mm")})
    if (value && !(*value > 0.0 && *value < 1e6))
      throw UsageError(field, fmt::format("{}", *value), "expected a length > 0 mm");
  Tool tool;
  if (names_a_tool_file(options.source)) {
    if (!options.parameters.empty())
      throw UsageError("param", "only for a family; " + options.source + " has its own parameters");
    // A drawing does not say how long the tool's axis is; a tool's own file does, and must not be contradicted.
    ToolReading reading = read_any_tool(options.source, options.axis_length_mm);
    tool = std::move(reading.tool);
    notes.insert(notes.end(), reading.notes.begin(), reading.notes.end());
  } else {
    ToolSpec spec = parse_tool_spec(options.source, "source");
    if (!spec.family) throw UsageError("source", options.source, "name a family with its parameters, or a tool.json");
    for (const std::string& text : options.parameters) {
      const auto [name, value] = parse_tool_parameter(*spec.family, text);
      if (!spec.given.emplace(name, value).second) throw UsageError("param", text, name + " is given twice");
    }
    tool = make_tool(*spec.family, spec.given, options.axis_length_mm.value_or(kDefaultToolLengthMm));
  }
  if (options.name) tool.name = *options.name;
  if (options.shank_diameter_mm) {
    const double top = meridian_point(tool.radial, tool.radial.axis_length()).x(),
                 radius = 0.5 * *options.shank_diameter_mm;
    // As long as the flank, from where the meridian ends (z, not s: the radius may change there).
    tool.shank = {{top, radius}, {top + tool.radial.axis_length(), radius}};
  }
  return tool;
}

std::string tool_as(const Tool& tool, const std::string& file, bool arcs) {
  const std::string ending = ending_of(file);
  if (ending == ".json") return tool_to_json(tool);
  if (ending == ".dxf") return tool_to_dxf(tool, arcs);
  if (ending == ".step" || ending == ".stp") return tool_to_step(tool);
  if (ending == ".fctb") return tool_to_fctb(tool);
  if (ending == ".svg") return tool_to_svg(tool);
  if (ending == ".csv") return profile_csv(tool.radial);
  throw UsageError("output", file, "unknown ending; accepted: .json, .dxf, .step, .fctb, .svg, .csv");
}

std::string tool_summary_json(const Tool& tool, const std::vector<std::string>& files) {
  const Legitimacy verdict = check_legitimacy(tool.radial);
  std::vector<std::string> names;
  for (const std::string& file : files) names.push_back(json_string(file));
  double least = tool.radial.at(0.0).r, most = least;
  for (int i = 1; i < kProfilePoints; ++i) {
    const double r = tool.radial.at(tool.radial.axis_length() * i / (kProfilePoints - 1)).r;
    least = std::min(least, r), most = std::max(most, r);
  }
  return fmt::format(
      "{{\"schema\": \"openflank/tool-summary/1\", \"family\": \"{}\", \"axis_length_mm\": {}, \"radius_min_mm\": {}, "
      "\"radius_max_mm\": {}, \"margin\": {}, \"files\": [{}]}}\n",
      family_name(tool.radial.family()), exact_number(tool.radial.axis_length()), exact_number(least),
      exact_number(most), exact_number(verdict.margin), fmt::join(names, ", "));
}

Tool run_tool_command(const ToolCommandOptions& options) {
  std::vector<std::string> notes;
  return run_tool_command(options, notes);
}

Tool run_tool_command(const ToolCommandOptions& options, std::vector<std::string>& notes) {
  const Tool tool = tool_of_command(options, notes);
  std::vector<std::string> contents;
  const auto is_dxf = [](const std::string& file) { return ending_of(file) == ".dxf"; };
  // An option without effect is a mistake that its user would not notice.
  for (const auto& [asked, name] : {std::pair(options.arcs, "arcs"), std::pair(options.polygon, "polygon")})
    if (asked && std::none_of(options.outputs.begin(), options.outputs.end(), is_dxf))
      throw UsageError(name, "only for a .dxf; name one as output");
  if (options.arcs && options.polygon) throw UsageError("polygon", "contradicts `arcs`");
  ReadFiles inputs;
  inputs.add(options.source, "as the tool");
  for (const std::string& file : options.outputs) inputs.require_not_written(file);
  // All contents first: an error in the last of them leaves no file behind.
  for (const std::string& file : options.outputs) contents.push_back(tool_as(tool, file, !options.polygon));
  for (std::size_t i = 0; i < contents.size(); ++i) write_file(options.outputs[i], contents[i]);
  return tool;
}

std::string tool_drawing(const Tool& tool) { return tool_to_ascii(tool); }

}  // namespace flank
