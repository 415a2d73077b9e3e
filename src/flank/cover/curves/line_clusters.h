/// k-means clustering of lines (paper B, section 4.4): a few lines that stand for many.
#pragma once

#include <cstdint>
#include <vector>

#include "flank/vec.h"

namespace flank::internal {

/// Squared distance of two axes of the same length, mm^2: the mean over s of |l_a(s) - l_b(s)|^2, which is that of their
/// middles plus L^2 / 12 |u_a - u_b|^2. Euclidean in (middle, L / sqrt(12) u), so means make sense.
[[nodiscard]] double squared_line_distance(const Pose& a, const Pose& b, double axis_length);
/// The same axis with tip and holder end exchanged: the same tool where r(s) = r(L - s).
[[nodiscard]] Pose turned_round(const Pose& pose, double axis_length);

struct LineClusterOptions {
  int clusters = 200;  ///< at most; paper B's k
  int rounds = 30;     ///< at most
  std::uint64_t seed = 1;
  bool ends_alike = false;  ///< a line turned round is the same line: distances are to the nearer of the two
};

struct LineClusters {
  std::vector<int> cluster;          ///< of each line
  std::vector<int> representatives;  ///< of each cluster: the line nearest to its mean
  int rounds = 0;
};

/// Lloyd's rounds from k-means++ centres; empty clusters are dropped. Same result for any number of threads.
[[nodiscard]] LineClusters cluster_lines(const std::vector<Pose>& lines, double axis_length,
                                         const LineClusterOptions& options);

}  // namespace flank::internal
