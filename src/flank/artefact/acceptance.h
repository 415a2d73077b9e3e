/// The one rule that says whether a result meets its request: exit codes, summaries, verify.json and the report all take
/// it from here.
#pragma once

#include <string>

#include "flank/run.h"

namespace flank::internal {

/// Passes: the work is complete, the tool legitimate, overcut on every target and every check face surely at most the
/// report's tolerance (its bound is; samples alone give one, too), coverage of what is reachable at least
/// `least_coverage` (its bound, where there is one), and every clearance kept.
[[nodiscard]] Acceptance accept(const Tool& tool, const VerifyReport& report, double least_coverage,
                                bool complete = true);

/// Adds what the replay of a cavity's program finds against it: engagement above the limit by more than its resolution (but
/// for strips that cut a slot to get in), material of more than kMostUncutMm (and two cells) left between the sides, faces
/// entered by more than the tolerance and a tenth of a cell.
inline constexpr double kMostUncutMm = 0.1;
void accept_stock(const StockReport& stock, double most_engagement_deg, double tolerance_mm, Acceptance& acceptance);

/// Adds what is not as asked of a cavity's cycles: their engagement, and that they are all there.
void accept_cavity(const TrochoidSummary& cavity, Acceptance& acceptance);

/// Adds that the path of tip or holder end bends more sharply than the job lets it (FitJob::min_bend_radius_mm).
void accept_bends(const PlanJob& job, const BendRadii& bends, Acceptance& acceptance);

/// "              F88 is entered ..." a line for each reason.
[[nodiscard]] std::string reason_lines(const Acceptance& acceptance);

}  // namespace flank::internal
