/// plan.json in the folder of a wheel (docs/schema/wheel.md), as those who judge, post and draw the folder need it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/path.h"
#include "flank/pipeline/folder/turned_copies.h"
#include "flank/setup/setup.h"

namespace flank::internal {

/// A ball of this radius touches what is open of the flow surface: places inside other solids, and below a blade's foot, are not.
/// As a share of the tolerance.
inline constexpr double kOpenBall = 5.0;

struct WheelStep {
  std::string id, kind;                 ///< "10", "rough"
  std::string folder;                   ///< of its result, beside the working folder
  int copies = 1;                       ///< its path and the turned ones
  std::vector<std::string> faces = {};  ///< of one sector
  bool done = false;
  std::string problem;  ///< why it is not done
};

/// A blade of the wheel that the part lacks: one that it has, turned.
struct LackingBlade {
  std::vector<std::string> faces;
  int turns = 1;  ///< pitches
};

struct WheelPlan {
  CopyAxis axis;
  std::optional<Vec3> up;             ///< unit vector along the axis: to the spindle; none in older files
  int sectors = 1;                    ///< in a whole turn
  bool whole = true;                  ///< the part has all of them
  std::string blank;                  ///< file of the blank, beside the working folder; empty: none
  double most_engagement_deg = 90.0;  ///< while roughing
  double most_free_mm = 0.0;          ///< while roughing, of a blade on one side alone; 0: no limit
  std::vector<LackingBlade> lacking;  ///< of a piece of a wheel
  std::vector<std::string> left_out;  ///< faces of solids that are no part of the wheel
  std::vector<WheelStep> steps;       ///< in the order of machining
  [[nodiscard]] std::vector<const WheelStep*> roughing() const;  ///< those that are done
};

/// None where the folder has no plan.json. Throws InputError, naming file and key, for one that cannot be used.
[[nodiscard]] std::optional<WheelPlan> read_wheel_plan(const std::string& folder);

/// Stands the blades that the part lacks on it: what they cover need not be finished. Faces of a blade that others are copies of count as
/// often as the part has them. Throws InputError for faces that the part does not have.
void stand_whole(const WheelPlan& plan, Setup& setup);

/// Throws InputError where the path is not that of the finishing steps and their copies: `file` is for the message.
void require_steps_make(const WheelPlan& plan, const Path& path, const std::string& file);

/// Every strip as often as there are copies, a sector after the other, numbered anew.
[[nodiscard]] Path all_copies(const Path& sector, const WheelPlan& plan, int copies);

}  // namespace flank::internal
