/// The reachable share of a job's targets, among all faces that the tool must not enter and in their own corners.
#pragma once

#include <map>
#include <vector>

#include "flank/judge.h"
#include "flank/setup/setup.h"
#include "flank/verify/reach.h"
#include "flank/verify/sampler.h"

namespace flank::internal {

/// The targets' samples, in the order of setup.targets.
[[nodiscard]] std::vector<FaceSamples> target_samples(const Setup& setup, double spacing_mm);

/// How the faces that a ball is held against are cut into triangles, mm.
struct ReachFineness {
  double fine_mm = 0.0, coarse_mm = 0.0;  ///< deviations where the ball may come near, and where it may not
  double cell_mm = 0.0;                   ///< the longest edge where it may
  /// The same on a face of this size where the ball may come near: beside a target of a millimetre no finer than on a blade.
  [[nodiscard]] double fine_on(double face_mm) const;
  [[nodiscard]] double cell_on(double face_mm) const;
};

/// For a ball of this radius. From 10 mm on all lengths grow with the ball, and below 1 mm they may shrink with it, so that a
/// part of any size, with a tolerance and a tool to match, takes as many triangles.
[[nodiscard]] ReachFineness reach_fineness(double tolerance_mm, double radius_mm);

/// The ball that says what is reachable.
struct ReachBall {
  double radius_mm = 1.0;
  /// Does the target itself hold it off in its corners? Not if it is as thick as the tool: that a tool does not fit into the
  /// target is no excuse of it.
  bool corners = true;
};

/// What a ball must keep out of, for each target, made ready once. Immutable.
class TargetReach {
 public:
  /// `samples` are target_samples of any spacing: where the targets are.
  TargetReach(const Setup& setup, const ReachBall& ball, const std::vector<FaceSamples>& samples);

  /// Fills `reachable` of samples of a target, given by its index in the part.
  void fill(int face, FaceSamples& samples) const;
  /// Of each sample of a target: the largest free ball, up to this one (ReachScene::largest_balls), mm.
  [[nodiscard]] std::vector<double> largest_balls(int face, const FaceSamples& samples) const;

 private:
  double radius_mm_ = 0.0;
  std::map<int, ReachScene> targets_;  ///< empty if there is nothing to keep out of
};

/// The largest ball, up to that of `reach`, that reaches at least `share` of the targets, by their `samples` (target_samples).
[[nodiscard]] FinerReach finer_reach(const Setup& setup, const TargetReach& reach,
                                     const std::vector<FaceSamples>& samples, double share);

/// `samples` of a tile, with their reachable shares, where those at the border of what is reachable (verify/reach_border) give
/// way to those of the parts of their cells: what is covered mostly ends where what is reachable does, and a cell there would be
/// covered as its middle is, or open as a whole.
[[nodiscard]] FaceSamples with_fine_border(const verify::Sampler& sampler, const TargetReach& reach, int face,
                                           const FaceSamples& samples);

}  // namespace flank::internal
