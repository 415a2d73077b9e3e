/// The roughing of a wheel, judged: what it cuts, and how much of the tool is in the blank.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/judge.h"
#include "flank/pipeline/folder/wheel_plan.h"
#include "flank/pipeline/judge/rough_left.h"
#include "flank/results/acceptance.h"
#include "flank/setup/setup.h"
#include "flank/tool.h"

namespace flank::internal {

struct JudgedRoughing {
  Tool tool;
  VerifyReport cuts;  ///< of all copies, on all judged faces: none of them may be cut
  StockReport stock;  ///< of one sector, in the whole blank: a copy meets no more material; kind "rough"
  double most_engagement_deg = 180.0;
  RoughLeft left;
  double free_mm = 0.0, most_free_mm = 0.0;  ///< of a blade on one side alone; 0: no limit
};

/// Of the steps of the plan that rough; none where none is done, or none is planned. Throws InputError for files of the folder that are
/// missing, damaged or not those that a step wrote.
[[nodiscard]] std::optional<JudgedRoughing> judge_roughing(const WheelPlan& plan, const Setup& setup);
/// The same of other paths with the steps' tool, as a program runs them: those of one sector in the whole blank, one for each step, and `all`
/// copies on the part.
[[nodiscard]] std::optional<JudgedRoughing> judge_roughing(const WheelPlan& plan, const Setup& setup,
                                                           const std::vector<Path>& steps, const Path& all);

/// One line for people.
[[nodiscard]] std::string roughing_text(const JudgedRoughing& roughing);

/// Reasons against the wheel: steps that are not done, and what roughing cuts or engages.
void accept_steps(const WheelPlan& plan, const std::optional<JudgedRoughing>& roughing, Acceptance& acceptance);

}  // namespace flank::internal
