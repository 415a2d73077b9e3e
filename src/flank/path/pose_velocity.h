/// How the axis moves at a pose of a strip.
#pragma once

#include <span>

#include "flank/vec.h"

namespace flank::internal {

/// Per mm of way, or in any other measure of time.
struct PoseVelocity {
  Vec3 tip = Vec3::Zero(), axis = Vec3::Zero();
  [[nodiscard]] Vec3 at(double s) const { return tip + s * axis; }
};

/// How far any point of an axis of this length goes between two poses, mm.
[[nodiscard]] double way_between(const Pose& a, const Pose& b, double length);

/// At pose k of a strip whose axis has this length: of the faster end of the axis one, so it is per mm of that end's way. Mean of both sides' directions: of a smooth
/// motion that was joined straight it is the tangent, to second order. Zero where nothing moves.
[[nodiscard]] PoseVelocity velocity_at(std::span<const Pose> poses, std::size_t k, double length);

}  // namespace flank::internal
