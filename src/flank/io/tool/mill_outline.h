/// Outlines of the mills that catalogues know by a few sizes.
#pragma once

#include "flank/io/tool/tool_outline.h"

namespace flank::internal {

/// A mill by its sizes, mm and radians; z = 0 is its lowest point.
struct Mill {
  double ball = 0.0;        ///< radius of a ball end; 0: none
  double tip_radius = 0.0;  ///< without a ball: radius where the flank begins
  double corner = 0.0;      ///< without a ball: corner radius of a cylinder's end
  double angle = 0.0;       ///< of the flank to the axis
  double height = 0.0;      ///< of the flank's upper end
};

/// Tip and flank of it. Throws InputError that begins with `file` for a flank of no length.
[[nodiscard]] ToolOutline mill_outline(const Mill& mill, const std::string& file);

}  // namespace flank::internal
