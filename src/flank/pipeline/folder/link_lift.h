/// Which way a tool leaves the surface that it has cut.
#pragma once

#include <vector>

#include "flank/judge.h"
#include "flank/machine/links.h"

namespace flank::internal {

/// An end of a strip: where the tool touches last, and which way it was going.
struct StripEnd {
  Pose contact;
  PoseVelocity motion = {};   ///< past the end, for every mm of the axis' middle
  Vec3 going = Vec3::Zero();  ///< unit vector: that of the middle; zero: it stands
};

/// Ways out for each end of each strip (beginning, end, beginning, ...), the best first:
/// 1. off the surface by `lift_mm`, or less, or not at all, and out along the tool's axis: those on which the tool keeps
///    farthest from the samples; arcs past the end go before straight ways where the best of them keeps at least half as far
///    from everything as the best straight one;
/// 2. where none of these is free of the samples: out of the part in other directions, the shortest way first;
/// 3. where none of those is, either: back along the strip, and out as at its other end; off the surface where there is room.
///    At a beginning only off the surface: there the strip has not been cut yet.
/// Ways that are not free follow behind those that are. Parallel; the same for any number of threads.
class LeadSearch {
 public:
  /// `tolerance_mm`: what a way may cut and be called free. `links`: the sphere that ways lead to.
  LeadSearch(const Tool& tool, const Path& strips, const std::vector<FaceSamples>& samples, double lift_mm,
             double tolerance_mm, const LinkOptions& links);

  [[nodiscard]] std::size_t ends() const { return ends_.size(); }
  [[nodiscard]] const Lead& lead(std::size_t end) const { return ways_[end][chosen_[end]].lead; }
  /// Goes on to an end's next best lead; false, and the lead stays, where there is no other.
  bool next(std::size_t end);

 private:
  struct Way {
    Lead lead;
    double distance = 0.0;  ///< least from the samples, mm
  };
  void leave_otherwise(std::size_t end);
  void go_back(const Path& strips);
  [[nodiscard]] bool free(std::size_t end) const { return ways_[end].front().distance >= -tolerance_mm_; }

  SweptVolume tool_;  ///< of one pose: what depends on the tool alone
  const std::vector<FaceSamples>& samples_;
  const LinkOptions& links_;
  std::vector<StripEnd> ends_;
  double lift_mm_, tolerance_mm_;
  std::vector<std::vector<Way>> ways_;  ///< of each end, the best first
  std::vector<std::size_t> chosen_;     ///< place in these
};

}  // namespace flank::internal
