/// The operations of a wheel and what was found of it, as values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/feature/wheel_roles.h"
#include "flank/pipeline/folder/judge_roughing.h"
#include "flank/run.h"
#include "flank/wheel/sector.h"

namespace flank::internal {

/// One operation: a result folder of one sector, or what stopped it.
struct WheelOperation {
  std::string id, kind;  ///< "20", "side"
  std::string folder;    ///< within the wheel's, "ops/20-side"
  std::string tool = "T1";
  std::vector<std::string> faces = {};
  double seconds = 0.0;
  int copies = 0;        ///< of its path in the whole wheel; 0: as many as of the wheel's finishing path
  std::string key = {};  ///< of what decides it: a finished operation of the same key is not done again
  bool done = false;
  bool kept = false;         ///< taken from the folder
  bool pass = false;         ///< meets what its own folder was asked
  std::string problem = {};  ///< why it is not done, or does not meet it
};

/// What was found of the faces of one role, by the judge of the whole.
struct RoleFigures {
  std::string role;
  double area_mm2 = 0.0, open_mm2 = 0.0,
         within_mm2 = 0.0;             ///< whole, not inside other material, of that within tolerance
  double cut_mm = 0.0, left_mm = 0.0;  ///< deepest cut, most that is left
};

/// A place of the flow surface on which more than the tolerance is left.
struct RestPlace {
  std::string face;
  Vec3 point = Vec3::Zero();  ///< the deepest of its places, on the part
  double area_mm2 = 0.0, depth_mm = 0.0;
  std::string reason;
};

struct WheelResult {
  WheelRoles roles;
  int copies = 0;
  double hub_sectors = 0.0;  ///< so many of the wheel's sectors the part has of its hub
  Vec3 up = Vec3::UnitZ();   ///< along the axis: to the spindle where the wheel is clamped
  std::vector<WheelOperation> operations;
  std::vector<WheelOperation> earlier;  ///< that an earlier run has finished, and this one has not come to yet
  std::vector<RoleFigures> figures;
  std::vector<std::string> notes;
  std::vector<RestPlace> rest;        ///< largest first
  std::vector<MissingBlade> lacking;  ///< what the wheel has and the part has not
  std::string blank;                  ///< "turned", or the file that it is from; empty: nothing is roughed
  double most_engagement_deg = 90.0, most_free_mm = 0.0;  ///< as in WheelPlan
  std::optional<JudgedRoughing> roughing;
  std::optional<Result> whole;  ///< all copies of all finishing operations, judged on all flow faces
  [[nodiscard]] Acceptance acceptance() const;
};

}  // namespace flank::internal
