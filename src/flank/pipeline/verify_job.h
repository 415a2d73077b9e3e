/// `flank verify DIR`: judges the tool and the path that lie in a folder.
#pragma once

#include <optional>
#include <string>

#include "flank/pipeline/fit_job.h"

namespace flank::internal {

struct VerifyJob {
  std::string folder;
  std::optional<std::string> part;     ///< instead of the part named in job.json
  std::optional<double> tolerance_mm;  ///< instead of the job's
  std::optional<double> sample_mm;
  std::optional<double> reach_radius_mm;  ///< instead of the job's
  CheckFaceChoice check;                  ///< instead of the job's choice, if any is given
  ClearanceJob clearance;                 ///< what is given takes the place of the tool's or the job's
};

struct VerifyOutcome {
  FitJob job;  ///< with the overrides
  VerifyReport report;
  std::vector<std::string> notes;
  Acceptance acceptance;
};

/// Reads job.json, tool.json and path.json, judges, and writes verify.json and view.json.
[[nodiscard]] VerifyOutcome run_verify(const VerifyJob& job);
[[nodiscard]] std::string verify_text(const VerifyOutcome& outcome);

}  // namespace flank::internal
