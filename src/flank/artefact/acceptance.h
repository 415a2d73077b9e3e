/// The one rule that says whether a result is what was asked for: exit codes, summaries, verify.json and the report all
/// take it from here.
#pragma once

#include <string>
#include <vector>

#include "flank/judge.h"
#include "flank/tool.h"

namespace flank::internal {

/// What is not as asked, and in which figure it shows.
struct Shortfall {
  std::string
      figure;        ///< name of the figure in verify.json ("overcut_mm", "gouge_mm", ...), "legitimate" or "complete"
  std::string text;  ///< one line for people: face, place, depth, strip
};

struct Acceptance {
  std::vector<Shortfall> reasons;
  [[nodiscard]] bool pass() const { return reasons.empty(); }
  [[nodiscard]] int exit_code() const { return pass() ? 0 : 1; }
};

/// Passes: the work is complete, the tool legitimate, overcut on every target and every check face at most the report's
/// tolerance, coverage of what is reachable at least `least_coverage`, and every clearance kept.
[[nodiscard]] Acceptance accept(const Tool& tool, const VerifyReport& report, double least_coverage,
                                bool complete = true);

/// "reachable   93.10 % of the target (ball of radius 1.5 mm), of which 99.20 % is covered".
[[nodiscard]] std::string reach_text(const VerifyReport& report);

/// "              F88 is entered ..." a line for each reason.
[[nodiscard]] std::string reason_lines(const Acceptance& acceptance);

}  // namespace flank::internal
