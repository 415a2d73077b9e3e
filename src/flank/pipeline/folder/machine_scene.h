/// The solids that a program's motion is judged with, beside the tool and the part: table and head of the machine.
#pragma once

#include <string>
#include <vector>

#include "flank/machine/body_check.h"
#include "flank/machine/work_setup.h"
#include "flank/results/acceptance.h"
#include "flank/setup/clearance_scene.h"
#include "flank/tool.h"

namespace flank::internal {

/// What the machine's solids are held against.
struct MachineScene {
  std::vector<SolidBody> solids;  ///< the machine's, the tool, part and fixtures; empty: the machine has no outline
  double required_mm = 0.0;
};

/// The machine's own solids and the tool: flank, shank and holder, as cones that hold them. `tip_offset`: from the
/// controlled point to s = 0, mm. Empty where the machine's file gives no outline.
[[nodiscard]] MachineScene machine_scene(const Machine& machine, const Tool& tool, double tip_offset);

/// Adds part and fixtures, where they sit.
void add_work(const Setup& setup, const ObstacleRequest& request, const WorkSetup& place, MachineScene& scene);

/// Reasons for every pair that comes too near; `where` says in words where a place of the track is.
template <class Where>
void judge_scene(const Machine& machine, double tool_length, const MachineScene& scene,
                 const std::vector<JointValues>& track, const Where& where, Acceptance& acceptance) {
  if (scene.solids.empty()) return;
  const Kinematics kinematics(machine, tool_length);
  for (const BodyHit& hit : check_bodies(machine, kinematics, scene.solids, track, scene.required_mm))
    add_reason(acceptance, Figure::kMachineBodies, where(hit.place) + ": " + hit_text(machine, hit));
}

}  // namespace flank::internal
