/// What stands behind `flank tool` and behind every `--tool` option: tool specs, making, showing and converting tools.
#pragma once

#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "flank/tool.h"

namespace flank::internal {

/// Axis length of `flank tool FAMILY` where none is given, mm.
inline constexpr double kDefaultToolLengthMm = 30.0;

/// A TOOL as the command line names it. Exactly one of three: free; a family of which some parameters are given; a
/// whole tool.
struct ToolSpec {
  bool free = false;                 ///< the radial function is the fit's to choose
  std::optional<ToolFamily> family;  ///< set for a family
  std::map<std::string, double>
      given;                 ///< by the names of parameter_names(family); mm and radians. The others are open.
  std::optional<Tool> tool;  ///< set for a tool.json

  /// Is every parameter of the family given?
  [[nodiscard]] bool complete() const;
};

/// Is it a family of which make_tool needs more than is given? A barrel's s0 it does not need.
[[nodiscard]] bool has_open_parameters(const ToolSpec& spec);

/// Parses "free", "cone", "cylinder:diameter=8", "cone:radius=2,angle=3", "barrel:arc=85,radius=5", or the name of a
/// tool.json (what ends in .json or .dxf or contains a slash). Lengths in mm, angles in degrees; "diameter" and
/// "end_diameter" stand for twice a radius, spellings of a family with blank, hyphen or underscore are one. "spline"
/// alone is "free". Throws UsageError that begins with `option` and lists the accepted names; InputError for a file
/// that is missing or no tool.
[[nodiscard]] ToolSpec parse_tool_spec(const std::string& text, const std::string& option = "--tool");

/// One "name=value" of a family as on the command line, into (parameter name, value in mm or radians). Throws
/// UsageError likewise.
[[nodiscard]] std::pair<std::string, double> parse_tool_parameter(ToolFamily family, const std::string& text,
                                                                  const std::string& option = "--param");

/// A whole tool from its parameters (mm, radians) and its axis length (mm). All are needed, but for the barrel's s0,
/// which is half the length if not given. Throws UsageError naming what is missing or unknown, and with
/// check_legitimacy's reason for what is no tool.
[[nodiscard]] Tool make_tool(ToolFamily family, const std::map<std::string, double>& parameters, double axis_length);

/// Options of `flank tool SOURCE [--param NAME=VALUE]... [--axis-length MM] [--shank-diameter MM] [-o FILE]...`
struct ToolCommandOptions {
  std::string source;  ///< a family's name, a family with parameters ("cone:radius=2,angle=3"), or a tool.json or .dxf
  std::vector<std::string> parameters;  ///< "radius=5", "angle=3" (degrees); for a family
  std::optional<double>
      axis_length_mm;  ///< for a family (default kDefaultToolLengthMm) and for a .dxf (default: what the profile spans)
  std::optional<double> shank_diameter_mm;  ///< a plain cylinder above the flank, as long as the axis
  std::optional<std::string> name;          ///< of the tool
  std::vector<std::string>
      outputs;  ///< files, by their endings: .json, .dxf, .step, .fctb, .svg, .csv (meridian); none: the drawing is printed
  bool show = false;   ///< print the drawing also when there are outputs
  bool json = false;   ///< print nothing but a summary in JSON
  bool quiet = false;  ///< print nothing when files are written
};

/// The tool that the options describe. Throws UsageError and InputError.
[[nodiscard]] Tool tool_of_command(const ToolCommandOptions& options);

/// A tool as the content of a file of this ending (".json", ".dxf", ".step" or ".stp", ".fctb", ".svg", ".csv"). Throws UsageError naming the
/// endings.
[[nodiscard]] std::string tool_as(const Tool& tool, const std::string& file);

/// The whole command: makes or reads the tool, writes every output (each whole or not at all), prints to `out`. Returns
/// the exit code, 0. Throws UsageError and InputError, before anything is written where the request itself is wrong.
int run_tool_command(const ToolCommandOptions& options, std::ostream& out);

}  // namespace flank::internal
