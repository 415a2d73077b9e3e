/// Faces that go more than once round the screw that moves them along themselves: threads, worms, long rotors. What is
/// found for half a turn in their middle goes with the screw over all of them (docs/algorithms/orbits.md).
#pragma once

#include <optional>

#include "flank/obstacle_field.h"
#include "flank/radial_function.h"
#include "flank/ruled_motion.h"
#include "flank/seed/self_motion.h"
#include "flank/setup/setup.h"

namespace flank::internal {

/// How the only face of the targets is wound.
struct WoundFace {
  SelfMotion motion;
  bool along_u = false;            ///< the parameter that goes with the screw
  Vec3 middle = Vec3::Zero();      ///< mm; a point of the face, passed at time 0
  double half_turn[2]{};           ///< parameters, rising, between which half a turn lies about the middle
  double first = 0.0, last = 0.0;  ///< times at which points of the face are at the ends of it; middle: 0

  /// Times round the axis.
  [[nodiscard]] double turns() const;
  /// Of a point beside the half turn: the time at which the screw brings the middle as far round the axis.
  [[nodiscard]] double time_of(const Vec3& p) const;
};

/// None, if the targets are not one face that winds by more than a turn and stays where it is, to a share of the tolerance,
/// wherever the screw moves its points.
[[nodiscard]] std::optional<WoundFace> find_wound_face(const Setup& setup);

/// The same part with the half turn in the place of the face; what is left of it on either side is checked.
[[nodiscard]] Setup half_turn_of(const Setup& setup, const WoundFace& wound);

/// The middle pose of a motion on the half turn, moved with the screw for as long as it touches the face, and no farther than
/// where the flank enters an obstacle deeper than in the middle. `half_turn`: the target of the motion.
[[nodiscard]] RuledMotion extend_along_screw(const WoundFace& wound, const Target& half_turn,
                                             const ObstacleField* obstacles, const RuledMotion& motion,
                                             const RadialFunction& tool, double tolerance_mm);

}  // namespace flank::internal
