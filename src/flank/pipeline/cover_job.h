/// `flank cover` as one function: part and tool in, strips and verdict out.
#pragma once

#include "flank/choose/tool_ranking.h"
#include "flank/cover.h"
#include "flank/pipeline/fit_job.h"

namespace flank::internal {

/// What the user asked for. Of `base`: part, unit, faces, side, tool, tolerance, axis length (of a family), coverage,
/// sample, clearance. `base.tool` is a tool, "catalogue", or a family of which parameters are open.
struct CoverJob {
  FitJob base;
  std::string strategy = "grow";  ///< or "curves"
  std::string seeds = "grid";     ///< or "shape": where `grow` begins its lines
  std::optional<int> most_strips;
  std::optional<double> strip_price;     ///< share of the area
  std::optional<std::string> catalogue;  ///< folder of tool files, for "catalogue"
  int finalists = 3;                     ///< tools that are covered in full
  MachiningRates rates;
  CoverOptions options;  ///< tolerance, strips and price are taken from the fields above

  CoverJob() {
    base.command = "cover";
    base.tool.clear();
  }
};

/// Reads, covers every target, samples and judges. Throws UsageError and InputError before any work is done. The
/// outcome is written by write_fit and shown by summary_text, with `job.base`.
[[nodiscard]] FitOutcome run_cover(const CoverJob& job, const Progress& progress);

}  // namespace flank::internal
