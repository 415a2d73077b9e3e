/// Whether the machine's own bodies, the tool, the part and its fixtures keep apart while the joints run.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "flank/machine/bodies/solid_body.h"
#include "flank/machine/kinematics.h"

namespace flank::internal {

/// The bodies of a machine's file as solids.
[[nodiscard]] std::vector<SolidBody> machine_solids(const Machine& machine);

/// Two solids that come too near, and where that is first found.
struct BodyHit {
  std::string moving, standing;  ///< on the tool's side; on the work's side or the bed
  double gap_mm = 0.0;           ///< there; 0: they meet
  std::size_t place = 0;         ///< on the way to this place of the track
  JointValues joints{};
};

/// All pairs of a solid on the work's side or the bed and one on the tool's side, but work and tool, which are judged
/// against each other elsewhere: at most one hit of each pair. Joints run straight from one place of the track to the next;
/// `required`: least distance, mm; at least kBodyErrorMm, at which they count as meeting. What is not told is proved, to kBodyErrorMm, for the whole motion: a bound of the
/// motion of any point of the two is held against their distance, and ways are halved where that is not enough.
[[nodiscard]] std::vector<BodyHit> check_bodies(const Machine& machine, const Kinematics& kinematics,
                                                std::span<const SolidBody> solids, std::span<const JointValues> track,
                                                double required);
inline constexpr double kBodyErrorMm = 0.01;

/// "spindle and table come within 0.000 mm of each other at X 12.000 Y ...".
[[nodiscard]] std::string hit_text(const Machine& machine, const BodyHit& hit);

}  // namespace flank::internal
