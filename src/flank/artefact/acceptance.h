/// The one rule that says whether a result meets its request: exit codes, summaries, verify.json and the report all take
/// it from here.
#pragma once

#include <string>

#include "flank/run.h"

namespace flank::internal {

/// Passes: the work is complete, the tool legitimate, overcut on every target and every check face at most the report's
/// tolerance (proved so, unless only samples were asked for), coverage of what is reachable at least `least_coverage`,
/// and every clearance kept.
[[nodiscard]] Acceptance accept(const Tool& tool, const VerifyReport& report, double least_coverage,
                                bool complete = true);

/// "reachable   93.10 % of the target (ball of radius 1.5 mm), of which 99.20 % is covered".
[[nodiscard]] std::string reach_text(const VerifyReport& report);

/// "proved: no place of the target is cut deeper than 0.0083 mm, none of other faces 0.0000 mm", or that samples were all.
[[nodiscard]] std::string depth_text(const VerifyReport& report);

/// "              F88 is entered ..." a line for each reason.
[[nodiscard]] std::string reason_lines(const Acceptance& acceptance);

}  // namespace flank::internal
