/// Moves before, between and after strips: off the surface, out along the tool, round the part on a safe sphere, and back.
#pragma once

#include <vector>

#include "flank/path.h"

namespace flank::internal {

struct LinkOptions {
  Box3 keep_out;             ///< of the part and what stands around it, in the part's frame
  double tool_radius = 0.0;  ///< largest of flank, shank and holder, mm
  double clearance = 5.0;    ///< mm, > 0: between the tool and keep_out on the sphere
  /// From the surface, one for each strip, in the part's frame: where the tool moves before it runs along its axis; zero
  /// vectors: straight along the axis.
  std::vector<Vec3> lift_at_start, lift_at_end;
};

inline constexpr const char* kLinkKind = "link";

/// Strips that begin where the one before ends (the same place and axis, to 1e-9) are one: a cavity's cycles are linked
/// already. The first one's id, kind and face stay.
[[nodiscard]] Path joined(const Path& path);

/// The strips with links (kind "link") around them: link, strip, link, ..., strip, link. Ids of strips stay; those of the
/// links follow them. On the sphere the tool points away from the part, so that nothing above its tip comes nearer.
/// No link leaves a strip's first or last pose by any way but these.
[[nodiscard]] Path with_links(const Path& path, const LinkOptions& options);

}  // namespace flank::internal
