/// `flank tool`: making and converting tools.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/tool.h"

namespace flank {

/// Axis length of a family if none is given, mm.
inline constexpr double kDefaultToolLengthMm = 30.0;

/// What `flank tool` is asked for.
struct ToolCommandOptions {
  /// A family's name, a family with parameters ("cone:radius=2,angle=3"), or a file: tool.json, .dxf, FreeCAD's .fctb, a library
  /// of Fusion (.json, one of several by "#NAME").
  std::string source;
  std::vector<std::string> parameters;  ///< "radius=5", "angle=3" (degrees); for a family
  /// For a family (default kDefaultToolLengthMm) and for a .dxf (default: what the profile spans).
  std::optional<double> axis_length_mm;
  std::optional<double> shank_diameter_mm;  ///< a plain cylinder above the flank, as long as the axis
  std::optional<std::string> name;          ///< of the tool
  std::vector<std::string> outputs;  ///< files, by their endings: .json, .dxf, .step, .fctb, .svg, .csv (meridian)
  bool arcs = false;                 ///< a .dxf holds the profile as arcs and lines, which is what it does anyway
  bool polygon = false;              ///< a .dxf holds the profile as a polygon, within 0.0001 mm
};

/// The tool that the options describe. Throws UsageError and InputError.
[[nodiscard]] Tool tool_of_command(const ToolCommandOptions& options);
/// The same; what must be known of how a file was read is added to `notes`.
[[nodiscard]] Tool tool_of_command(const ToolCommandOptions& options, std::vector<std::string>& notes);

/// A tool as the content of a file of this ending (".json", ".dxf", ".step" or ".stp", ".fctb", ".svg", ".csv"). Throws
/// UsageError naming the endings. `arcs`: a .dxf with arcs, not with a polygon.
[[nodiscard]] std::string tool_as(const Tool& tool, const std::string& file, bool arcs = true);

/// Makes or reads the tool and writes every output, each whole or not at all. Throws UsageError and InputError, before
/// anything is written if the request itself is wrong.
Tool run_tool_command(const ToolCommandOptions& options);
Tool run_tool_command(const ToolCommandOptions& options, std::vector<std::string>& notes);

/// Family, axis length, radii, margin of legitimacy and the names of the files, as JSON.
[[nodiscard]] std::string tool_summary_json(const Tool& tool, const std::vector<std::string>& files);

/// The profile in characters, for a terminal: 78 columns and 16 rows.
[[nodiscard]] std::string tool_drawing(const Tool& tool);

}  // namespace flank
