/// Moves before, between and after strips: off the surface, out of the part, round it on a safe sphere, and back.
#pragma once

#include <vector>

#include "flank/path.h"
#include "flank/path/pose_velocity.h"
#include "flank/path/strip_kind.h"

namespace flank::internal {

/// How a tool leaves the surface at the end of a strip, or, backwards, comes to it at the beginning.
struct Lead {
  Vec3 off = Vec3::Zero();  ///< mm, across the axis, from the surface; zero: straight along the axis
  /// How the motion goes on past the strip's end, turns included: for every mm of the way of an axis point that goes across `off`. None: straight off.
  PoseVelocity along = {};
  Vec3 out = Vec3::Zero();      ///< unit vector along which the tool then leaves the part; zero: along its axis
  std::vector<Pose> back = {};  ///< run before all of that: back along the strip, to where the tool can leave
  [[nodiscard]] bool is_arc() const { return !along.tip.isZero() || !along.axis.isZero(); }
};

/// The poses of a lead up to where the tool leaves the part, the contact first, then those of `back`. Past the end on an arc tangent to the motion in place and in direction,
/// so that no mark is left where the tool would turn off, and no axis of the machine has to stop there: of 60 degrees and radius 2 |off|; or straight off.
[[nodiscard]] std::vector<Pose> lead_out(const Pose& contact, const Lead& lead);

/// The order of the strips, by index, in which the ways between them round a box are short: the turn of the outward
/// direction and of the axis from the end of one to the beginning of the next. Each runs in its own direction. Nearest
/// first, then by exchanges as long as one is shorter; the first strip stays the first.
[[nodiscard]] std::vector<std::size_t> short_order(const Path& path, const Box3& box);

struct LinkOptions {
  Box3 keep_out;             ///< of the part and what stands around it, in the part's frame
  double tool_radius = 0.0;  ///< largest of flank, shank and holder, mm
  double clearance = 5.0;    ///< mm, > 0: between the tool and keep_out on the sphere
  /// One for each strip, in the part's frame.
  std::vector<Lead> lead_at_start, lead_at_end;
};

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

/// From a lead's last pose to where the whole tool, and all that is above it, is outside of the sphere: that pose first, the
/// last one on the sphere, pointing outward.
[[nodiscard]] std::vector<Pose> way_to_sphere(const Pose& from, const Lead& lead, const LinkOptions& options);

/// Where the tool stands above the part: on the sphere, in the direction in which it points.
[[nodiscard]] Pose above(const LinkOptions& options, const Vec3& up);

/// The path of with_links, begun and ended above the part with the tool along `up` (unit): the way of the first and of the
/// last link goes on round the sphere.
[[nodiscard]] Path upright(Path linked, const LinkOptions& options, const Vec3& up);

}  // namespace flank::internal
