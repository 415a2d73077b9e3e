/// k-means clustering of lines (paper B, section 4.4): a few lines that stand for many.
#pragma once

#include <cstdint>
#include <vector>

#include "flank/vec.h"

namespace flank::internal {

/// Squared distance of two axes of the same length, mm^2: the mean over s of |l_a(s) - l_b(s)|^2, which is that of
/// their middles plus L^2 / 12 |u_a - u_b|^2. Euclidean in (middle, L / sqrt(12) u), so means make sense.
[[nodiscard]] double squared_line_distance(const Pose& a, const Pose& b, double axis_length);
/// The same axis with tip and holder end exchanged: the same tool if r(s) = r(L - s).
[[nodiscard]] Pose turned_round(const Pose& pose, double axis_length);

struct LineClusterOptions {
  int clusters = 200;       ///< at most, >= 1; paper B's k. See CurvesOptions::clusters for what it changes
  int rounds = 30;          ///< most rounds of Lloyd, >= 0; they end by themselves when no line changes its cluster
  std::uint64_t seed = 1;   ///< of the generator that draws the first centres; another one gives other clusters
  bool ends_alike = false;  ///< a line turned round is the same line: distances are to the nearer of the two
};

struct LineClusters {
  std::vector<int> cluster;          ///< of each line: index into representatives
  std::vector<int> representatives;  ///< of each cluster: the line nearest to its mean, an index into the lines
  int rounds = 0;                    ///< that were run
};

/// Lloyd's rounds from k-means++ centres (Arthur, Vassilvitskii 2007); empty clusters are dropped. A local optimum,
/// which depends on the seed. Same result for any number of threads. No lines: no clusters.
[[nodiscard]] LineClusters cluster_lines(const std::vector<Pose>& lines, double axis_length,
                                         const LineClusterOptions& options);

}  // namespace flank::internal
