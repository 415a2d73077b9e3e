/// From the outline of a tool, as drawings and other programs' tool files state it, to the tool.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/io/tool/profile_arcs.h"
#include "flank/tool.h"

namespace flank::internal {

/// Half a tool in its own plane: z along the axis towards the holder, rho from it, mm, from any z.
struct ToolOutline {
  std::string name;
  std::vector<ProfileArc> flank;  ///< joined, from the tip to the holder; lines and arcs as they are, curves as chords
  /// z of the lowest point of the whole tool; none: the outline is of the flank alone and has no tip.
  std::optional<double> bottom;
  bool ball = false;                ///< the tip is a ball that goes on into the flank
  double corner_mm = 0.0;           ///< corner radius of another tip, as far as it is known
  std::vector<Vec2> shank, holder;  ///< (z, rho), z not falling
};

/// A tool, and what its user must know of how it was read.
struct ToolReading {
  Tool tool;
  std::vector<std::string> notes;
};

/// How far the spheres may be from a flank that is neither one line nor one arc, mm.
inline constexpr double kOutlineErrorMm = 3e-4;

/// The tool whose spheres the flank envelops. One line is a cylinder or a cone, one arc a barrel, exactly; anything else a
/// spline of as many coefficients as kOutlineErrorMm needs. s = 0 is where the first normal of the flank meets the axis; of a
/// tool whose end is flat or has a corner radius where a sphere inside it touches its lowest plane, and a note says how
/// far the corner stands out of that sphere. With `axis_length` (mm) as in radial_from_meridian. Throws InputError that begins
/// with `file` for what no spheres can fill.
[[nodiscard]] ToolReading tool_from_outline(const ToolOutline& outline, const std::string& file,
                                            std::optional<double> axis_length = {});

/// Radius of the enveloped flank at height z above s = 0, mm; z between those of the meridian's ends.
[[nodiscard]] double radius_at_height(const RadialFunction& radial, double z);

/// Points of a profile for a shank or holder: of arcs, chords no farther than 1e-4 mm from them.
[[nodiscard]] std::vector<Vec2> profile_points(const std::vector<ProfileArc>& pieces);

}  // namespace flank::internal
