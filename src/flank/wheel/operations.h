/// The operations of one sector.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "flank/tool.h"
#include "flank/wheel/run_wheel.h"
#include "flank/wheel/sector.h"

namespace flank::internal {

/// What operations hand on.
struct WheelWork {
  const WheelJob& job;
  const WheelRoles& roles;
  const WheelSector& sector;
  const Part& part;
  std::map<std::string, WheelOperation> finished;  ///< of an earlier run, by id
  std::optional<Tool> tool;                        ///< T1
  Path finish;                                     ///< strips of the sector that finish something, in their order
};

/// Both sides of the sector's blades, by one tool that is found or given: `fit`.
[[nodiscard]] WheelOperation side_operation(WheelWork& work, const Progress& progress);
/// The hub between the blades, by passes of the tool's tip sphere.
[[nodiscard]] WheelOperation floor_operation(WheelWork& work, const Progress& progress);
/// Leading and trailing edges of the sector's blades, by strips of the same tool: `cover`.
[[nodiscard]] WheelOperation edge_operation(WheelWork& work, const Progress& progress);
/// The channels of the sector, by trochoidal layers with the same tool.
[[nodiscard]] WheelOperation rough_operation(WheelWork& work, const Progress& progress);

}  // namespace flank::internal
