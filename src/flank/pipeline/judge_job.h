/// The judge's work for `flank fit` and `flank verify`: samples, reachable share and figures.
#pragma once

#include <vector>

#include "flank/part.h"
#include "flank/pipeline/fit_job.h"

namespace flank::internal {

/// Judges tool and path on the part: `targets` and `checks` are indices into its faces. Shank, holder and fixtures are
/// not in it (measure_clearance). Throws UsageError for a --reach-radius that is not > 0.
[[nodiscard]] VerifyReport judge_job(const FitJob& job, const Part& part, const std::vector<int>& targets,
                                     const std::vector<int>& checks, const Tool& tool, const Path& path);

/// Fills `reachable` of the targets' samples for a ball of the radius.
void measure_reach(const Part& part, const std::vector<int>& targets, const std::vector<int>& checks, const Tool& tool,
                   const Path& path, double radius_mm, double tolerance_mm, std::vector<FaceSamples>& samples);

/// Throws UsageError for a --reach-radius that is not > 0.
void check_reach_radius(const FitJob& job);

/// Spacing of the judge's samples on the target where none is given, mm.
[[nodiscard]] double default_spacing(double diagonal_mm);

}  // namespace flank::internal
