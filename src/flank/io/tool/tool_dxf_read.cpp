#include "flank/io/tool/tool_dxf_read.h"

#include "flank/io/tool/dxf_curves.h"
#include "flank/io/tool/dxf_outline.h"

namespace flank::internal {

std::vector<Vec2> profile_from_dxf(std::string_view text, const std::string& file) {
  return profile_points(outline_of_drawing(read_dxf_curves(text, file), file).flank);
}

ToolReading read_tool_drawing(std::string_view text, const std::string& file, std::optional<double> axis_length) {
  return tool_from_outline(outline_of_drawing(read_dxf_curves(text, file), file), file, axis_length);
}

Tool tool_from_dxf(std::string_view text, const std::string& file, std::optional<double> axis_length) {
  return read_tool_drawing(text, file, axis_length).tool;
}

}  // namespace flank::internal
