/// The verdict as a table (run.h: verify_text), and those of its lines that summaries have, too.
#pragma once

#include <string>

#include "flank/judge.h"

namespace flank::internal {

/// "0.2 mm left on purpose: ..."; empty where nothing is.
[[nodiscard]] std::string allowance_text(const VerifyReport& report);

/// "reachable   93.10 % of the target (ball of radius 1.5 mm), of which 99.20 % is covered".
[[nodiscard]] std::string reach_text(const VerifyReport& report);

/// "proved: no place of the target is cut deeper than 0.0083 mm, none of other faces 0.0000 mm", or that samples were all.
[[nodiscard]] std::string depth_text(const VerifyReport& report);

/// A line for each open sheet whose side was asked for: "  side        F1: side +, towards ...: as asked". The others are cautions.
[[nodiscard]] std::string sheet_side_text(const VerifyReport& report);

/// One line per figure: "  shank       keeps 0.1230 mm from other faces, true to 0.0010 mm: F88 at ...".
[[nodiscard]] std::string clearance_text(const ClearanceReport& report);

}  // namespace flank::internal
