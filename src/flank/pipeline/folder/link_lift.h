/// Which way a tool leaves the surface that it has cut.
#pragma once

#include <vector>

#include "flank/judge.h"
#include "flank/machine/links.h"

namespace flank::internal {

/// An end of a strip: where the tool touches last, and which way it was going.
struct StripEnd {
  Pose contact;
  Vec3 going = Vec3::Zero();  ///< any length; of the axis' middle, past the end
};

/// A lead for each end, `lift_mm` off the surface, or less, or none: that on which the tool keeps farthest from the samples, and
/// likewise while it then runs along its axis for `run_mm`. Arcs past the end go before straight ways where the best of them
/// keeps at least half as far from everything as the best straight one. Parallel; the same for any number of threads.
class LeadSearch {
 public:
  LeadSearch(const Tool& tool, std::vector<StripEnd> ends, const std::vector<FaceSamples>& samples, double lift_mm,
             double run_mm);

  [[nodiscard]] std::size_t ends() const { return ends_.size(); }
  [[nodiscard]] Lead lead(std::size_t end) const;
  /// Goes on to an end's next best lead; false, and the lead stays, where there is no other.
  bool next(std::size_t end);

 private:
  std::vector<StripEnd> ends_;
  double lift_mm_;
  std::vector<std::vector<std::size_t>> ways_;  ///< of each end, the best first
  std::vector<std::size_t> chosen_;             ///< place in these
};

}  // namespace flank::internal
