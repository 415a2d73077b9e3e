/// What the operations of a wheel hand on.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "flank/tool.h"
#include "flank/wheel/sector.h"
#include "flank/wheel/wheel_job.h"

namespace flank::internal {

struct WheelWork {
  const WheelJob& job;
  const WheelRoles& roles;
  const WheelSector& sector;
  const Part& part;
  std::map<std::string, WheelOperation> finished;  ///< of an earlier run, by id
  std::optional<Tool> tool;                        ///< T1
  Path finish;                                     ///< strips of the sector that finish something, in their order
};

}  // namespace flank::internal
