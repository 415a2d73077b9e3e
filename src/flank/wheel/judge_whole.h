/// Paths that are put together judged as results, and the whole wheel.
#pragma once

#include <string>
#include <vector>

#include "flank/pipeline/folder/wheel_plan.h"
#include "flank/wheel/wheel_work.h"

namespace flank::internal {

/// How closely: an operation's own verdict is a draft, at few samples; the whole is judged as the job says.
enum class Care { kDraft, kFull };

/// Some of the wheel's faces, and all but what is no part of it in the way.
[[nodiscard]] PartRequest part_request(const WheelWork& work, const std::vector<std::string>& faces);
[[nodiscard]] ObstacleRequest obstacle_request(const WheelWork& work);

/// A path of one of the work's tools over some faces, judged as a cover of that tool. `least`: the share of what is open that counts as
/// done.
[[nodiscard]] Result judged_path(const WheelWork& work, const std::vector<std::string>& faces, Path path, double least,
                                 Care care, const std::string& tool = "T1");

/// The result in an operation's folder with another shank or holder on its tool: they are judged, and the flank's figures stay.
[[nodiscard]] Result with_tool(const std::string& folder, const Tool& tool);

/// All sectors that the part has, on all its flow faces.
[[nodiscard]] Result judge_whole(const WheelWork& work);

/// The judge's figures, by what the faces are.
[[nodiscard]] std::vector<RoleFigures> role_figures(const WheelRoles& roles, const VerifyReport& report);

}  // namespace flank::internal
