/// Ways of the tool out of a cavity and into it, where nothing is cut.
#pragma once

#include <vector>

#include "flank/path.h"
#include "flank/trochoid/paths/half_guard.h"

namespace flank::internal {

/// Where a tool is clear: `top` is a unit vector out of the cavity, and at `height` along it nothing is left.
struct ClearPlane {
  Vec3 top;
  double height = 0.0;
};

/// Ways beside a pose; zero: that way is closed.
struct WayOut {
  Vec3 outward = Vec3::Zero();  ///< along the feed's run-out
  Vec3 aside = Vec3::Zero();    ///< so far, mm, off a side and into what is cleared
};

/// Poses from `from` until the tip is above the plane, the axis turning nowhere: along the axis, or else another way of which
/// no more is known to enter a face (straight up; between both; outward, or aside, and then up). Where every
/// way enters one deeper than `allowed_mm`, the one that enters least.
[[nodiscard]] std::vector<Pose> retract(const Pose& from, const WayOut& beside, const ClearPlane& clear,
                                        const RadialFunction& radial, const HalfGuard& guard, double allowed_mm);

/// The way of a link, first drawn up along the axis as far as it takes to enter no face deeper than `allowed_mm`, and down again where it
/// ends, if that helps: a floor may rise between its ends.
[[nodiscard]] std::vector<Pose> off_floor(std::vector<Pose> way, const RadialFunction& radial, const HalfGuard& guard,
                                          double allowed_mm);

/// Poses from one to the other, both included: the middle of the axis, of that length in mm, goes straight, and the axis turns
/// evenly by no more than the angle from pose to pose.
[[nodiscard]] std::vector<Pose> poses_between(const Pose& from, const Pose& to, double axis_length,
                                              double largest_turn_rad);

}  // namespace flank::internal
