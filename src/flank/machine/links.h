/// Moves before, between and after strips: off the surface, out along the tool, round the part on a safe sphere, and back.
#pragma once

#include <vector>

#include "flank/path.h"

namespace flank::internal {

/// How a tool leaves the surface at the end of a strip, or, backwards, comes to it at the beginning.
struct Lead {
  Vec3 off = Vec3::Zero();    ///< mm, across the axis, from the surface; zero: straight along the axis
  Vec3 along = Vec3::Zero();  ///< unit vector across `off` that goes on past the strip's end; zero: straight off
};

/// The poses of a lead, the contact first. Past the end on an arc tangent to the motion, so that no mark is left where the
/// tool would turn off, of 60 degrees and radius 2 |off|; or straight off.
[[nodiscard]] std::vector<Pose> lead_out(const Pose& contact, const Lead& lead);

/// The order of the strips, by index, in which the ways between them round a box are short: the turn of the outward
/// direction and of the axis from the end of one to the beginning of the next. Each runs in its own direction. Nearest
/// first, then by exchanges as long as one is shorter; the first strip stays the first.
[[nodiscard]] std::vector<std::size_t> short_order(const Path& path, const Box3& box);

struct LinkOptions {
  Box3 keep_out;             ///< of the part and what stands around it, in the part's frame
  double tool_radius = 0.0;  ///< largest of flank, shank and holder, mm
  double clearance = 5.0;    ///< mm, > 0: between the tool and keep_out on the sphere
  /// One for each strip, in the part's frame; after a lead the tool runs along its axis.
  std::vector<Lead> lead_at_start, lead_at_end;
};

inline constexpr const char* kLinkKind = "link";

/// A path of which some is known at each pose: one value a pose of each strip; an empty list where it is not known.
struct KnownPath {
  Path path;
  std::vector<std::vector<double>> known;
};

/// Strips that begin where the one before ends (the same place and axis, to 1e-9) are one: a cavity's cycles are linked
/// already. The first one's id, kind and face stay. Of the pose that two strips share the larger value is kept.
[[nodiscard]] KnownPath joined(const KnownPath& path);

/// The strips with links (kind "link") around them: link, strip, link, ..., strip, link. Ids of strips stay; those of the
/// links follow them. On the sphere the tool points away from the part, so that nothing above its tip comes nearer.
/// No link leaves a strip's first or last pose by any way but these.
[[nodiscard]] Path with_links(const Path& path, const LinkOptions& options);

}  // namespace flank::internal
