/// One operation of a program as its machine runs it: its motion in the part, and what speaks against it beside what it cuts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/job.h"
#include "flank/machine/backplot.h"
#include "flank/machine/model/machine.h"
#include "flank/machine/nc/program.h"
#include "flank/pipeline/folder/turned_copies.h"
#include "flank/pipeline/program/followed_path.h"
#include "flank/run.h"
#include "flank/setup/setup.h"
#include "flank/tool.h"

namespace flank::internal {

/// What the judge needs beside the program.
struct ProgramQuestion {
  PartRequest part;
  ObstacleRequest obstacles;
  JudgeRequest judge;
  std::optional<double> tolerance_mm;
  Tool tool;
  bool in_place = false;  ///< a turned copy is held against the part where it is; else it is turned back first
};

struct OperationRun {
  Backplot plot;          ///< in place, or turned back
  FollowedPath followed;  ///< without a path that is planned: empty
};

/// Runs it, and adds what is wrong with set-up, rapids, travel, speed and machine, and with its way where a path is planned, to the reasons.
/// Throws UsageError and InputError.
[[nodiscard]] OperationRun run_operation(const VerifyJob& request, const ProgramQuestion& q, const Setup& setup,
                                         Machine machine, const NcProgram& program, const std::optional<Path>& planned,
                                         Verification& outcome);

/// The judge's reasons before those that are about the program.
void prepend(Acceptance first, Acceptance& all);

/// Reasons against operations of one program, each with its folder: two set-ups, two axes of copies, two tools of one number.
void accept_together(const VerifyJob& request, const std::vector<NcProgram>& operations,
                     const std::vector<std::string>& folders, Acceptance& acceptance);

/// The turn of a program's operation that is a copy, as its header has it: copy 1, or no copy: none.
[[nodiscard]] Eigen::Isometry3d turn_of(const std::string& file, const NcProgram& program);

}  // namespace flank::internal
