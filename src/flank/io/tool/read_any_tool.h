/// Tools and holders by the files that people have.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/io/tool/tool_outline.h"

namespace flank::internal {

/// Does the text look like a tool's file: an ending that is read, with "#NAME" behind it or not, or a slash? By its look, not by
/// being there: a misspelled file must be missed as a file.
[[nodiscard]] bool names_a_tool_file(const std::string& text);

/// A tool.json, a library of Fusion (.json, one tool of it by "#NAME"), a tool bit of FreeCAD (.fctb), a drawing (.dxf).
/// `axis_length` (mm) goes with a drawing, which does not say it. Throws InputError, and UsageError for a length with
/// a file that has its own.
[[nodiscard]] ToolReading read_any_tool(const std::string& name, std::optional<double> axis_length = {});

/// A holder's file that counts from its own face and not from the flank: .fcholder, .dxf, a library of Fusion. Nothing for
/// another file.
[[nodiscard]] std::optional<std::vector<Vec2>> read_holder_file(const std::string& name);

}  // namespace flank::internal
