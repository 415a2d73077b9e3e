/// tool.json (docs/schema/tool.md): a tool as a file.
#pragma once

#include <string>
#include <string_view>

#include "flank/tool.h"

namespace flank {

/// Fewest samples (s, r) that a tool.json is written with.
inline constexpr int kToolSamples = 201;
/// How far samples may be from the radial function that a file also states, mm.
inline constexpr double kToolSampleErrorMm = 1e-6;
/// How far the spline may be from a file's samples where they are all that it has, mm.
inline constexpr double kToolSplineErrorMm = 1e-3;

/// The whole file. Numbers read back as the same doubles. Throws InternalError for numbers that are not finite.
[[nodiscard]] std::string tool_to_json(const Tool& tool);

/// The tool of a tool.json's text; `file` is for messages. Family and parameters are taken as they stand, so that a
/// written tool reads back exactly; where there are only samples, the spline with the fewest coefficients that
/// reproduces them (to 1e-9 mm if it can, to kToolSplineErrorMm at worst). Throws InputError, naming file and key, for
/// anything that is not a legitimate tool: wrong schema, unknown or repeated keys, numbers missing or not finite,
/// samples that contradict the parameters, r <= 0, |r'| >= 1, a shank or holder that is no profile.
[[nodiscard]] Tool tool_from_json(std::string_view text, const std::string& file);

/// The same for a file on disk.
[[nodiscard]] Tool read_tool(const std::string& file);

/// Writes the file whole or not at all. Throws InputError naming the file if it cannot be written.
void write_tool(const Tool& tool, const std::string& file);

}  // namespace flank
