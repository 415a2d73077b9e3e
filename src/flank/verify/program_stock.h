/// A whole program replayed by the judge in a stock of its own, and what is left of it (MATH section 10).
#pragma once

#include <optional>
#include <vector>

#include "flank/judge.h"
#include "flank/path/engaged_arcs.h"
#include "flank/path/half_space.h"

namespace flank::internal {

struct ProgramStockOptions {
  std::optional<double> cell_mm;      ///< none: so that there are about as many lines as a second or two a metre allow
  double most_engagement_deg = 60.0;  ///< the limit, for the resolution
  double tolerance_mm = 0.01;         ///< what counts as a covered place of a target
  double most_triangles = 0.0;        ///< of what is left; 0: no mesh
};

struct ProgramStock {
  StockReport report;
  /// Of every pose of every strip: the largest engagement along the flank, radians, to 1e-4. Beside resolution_deg.
  std::vector<std::vector<double>> engagement;
  PathArcs arcs;      ///< of every circle of the flank that was looked at
  TriangleMesh left;  ///< closed; empty if none was asked for
};

/// Cuts the blank (the points that all half spaces hold, as far as the tool goes) by all strips in their order, and measures.
/// `faces` are the judge's samples of targets and check surfaces. Throws UsageError for a cell that is not > 0 and
/// InputError for a tool that is none, poses that are none, and a path that never meets the blank. The same bits for any number of threads.
[[nodiscard]] ProgramStock replay_program(const Tool& tool, const Path& path, const std::vector<HalfSpace>& blank,
                                          std::vector<FaceSamples> faces, const ProgramStockOptions& options);

/// Cuts a closed blank, as far as the tool goes, by all strips in their order: engagement, volume and way, of one kind, "rough". The lines of the stock are as near as the
/// tool's smallest radius asks for, or as they may be many. Throws InputError for a blank that is not closed or that the path never meets, and a tool that is none. The same bits for
/// any number of threads.
[[nodiscard]] StockReport rough_stock(const Tool& tool, const Path& path, const TriangleMesh& blank,
                                      double most_engagement_deg);

}  // namespace flank::internal
