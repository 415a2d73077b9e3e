/// What stands behind `flank tool` and behind every request for a tool: the words that name one, and making it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "flank/tool.h"

namespace flank::internal {

/// A tool as a user names it. Exactly one of three: free; a family of which some parameters are given; a
/// whole tool.
struct ToolSpec {
  bool free = false;                 ///< the radial function is the fit's to choose
  std::optional<ToolFamily> family;  ///< set for a family
  /// By the names of parameter_names(family); mm and radians. The others are open.
  std::map<std::string, double> given;
  std::optional<Tool> tool;        ///< set for a tool's file
  std::vector<std::string> notes;  ///< what must be known of how that was read

  /// Is every parameter of the family given?
  [[nodiscard]] bool complete() const;
};

/// Is it a family of which make_tool needs more than is given? A barrel's s0 it does not need.
[[nodiscard]] bool has_open_parameters(const ToolSpec& spec);

/// Parses "free", "cone", "cylinder:diameter=8", "cone:radius=2,angle=3", "barrel:arc=85,radius=5", or the name of a
/// tool.json (what ends in .json or .dxf or contains a slash). Lengths in mm, angles in degrees; "diameter" and
/// "end_diameter" stand for twice a radius, spellings of a family with blank, hyphen or underscore are one. "spline"
/// alone is "free". Throws UsageError of the field that lists the accepted names; InputError for a file
/// that is missing or no tool.
[[nodiscard]] ToolSpec parse_tool_spec(const std::string& text, const std::string& field = "tool");

/// One "name=value" of a family as users write it, into (parameter name, value in mm or radians). Throws
/// UsageError likewise.
[[nodiscard]] std::pair<std::string, double> parse_tool_parameter(ToolFamily family, const std::string& text,
                                                                  const std::string& field = "param");

/// A whole tool from its parameters (mm, radians) and its axis length (mm). All are needed, but for the barrel's s0,
/// which is half the length if not given. Throws UsageError naming what is missing or unknown, and with
/// check_legitimacy's reason for what is no tool.
[[nodiscard]] Tool make_tool(ToolFamily family, const std::map<std::string, double>& parameters, double axis_length);

/// A whole tool: a file, or a family with all its parameters and the length of its axis. Throws UsageError of the fields
/// `tool` and `axis_length_mm`; `not_free` says why the word "free" is none; `notes` gets what must
/// be known of how a file was read.
[[nodiscard]] Tool given_tool(const std::string& spec, std::optional<double> axis_length_mm,
                              const std::string& not_free, std::vector<std::string>& notes);

}  // namespace flank::internal
