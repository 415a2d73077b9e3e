/// The line in which a terminal shows how far a calculation is.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "flank/progress.h"

namespace flank::cli {

/// How long a calculation will take yet, from the shares that it reports.
///
/// Every report gives a moment at which all would be done at the pace so far; the estimate is a mean of these moments,
/// which follows them slowly, and it counts down between reports. It is told only when it means something: after a time
/// and a share that are worth a pace, and while the last moments agree with their mean.
class TimeLeft {
 public:
  /// `share` in [0, 1] was finished after `seconds` (not falling). One below an earlier share begins anew: a calculation
  /// that goes back does something else.
  void report(double seconds, double share);
  /// After `seconds`; none: nobody knows.
  [[nodiscard]] std::optional<double> seconds(double seconds) const;

 private:
  double begin_seconds_ = 0.0, begin_share_ = 0.0;  ///< of the pace
  double share_ = -1.0, at_seconds_ = 0.0;          ///< of the last report; none yet
  int moments_ = 0;                                 ///< that the means are of
  double done_at_ = 0.0;                            ///< seconds: mean moment at which all is done
  double spread_ = 0.0;                             ///< seconds: mean distance of a moment from that
};

/// "about 40 s left", "about 3 min left".
[[nodiscard]] std::string time_left_text(double seconds);

/// Stage, share, best so far and time left, as far as they are known.
class ProgressLine {
 public:
  /// Keeps the best: what is clean before what is not, unless it covers less than half as much; then what covers more.
  void found(const BestSoFar& found);
  /// "polish 62 %, best 97.3 %, about 40 s left".
  [[nodiscard]] std::string line(std::string_view stage, double share, double seconds);
  /// The same for programs, one line of JSON: {"stage", "share", "eta_s", "best"}. Its share never falls, also where the
  /// calculation begins anew; what is not known is null.
  [[nodiscard]] std::string json(std::string_view stage, double share, double seconds);

 private:
  std::optional<BestSoFar> best_;
  TimeLeft left_;
  double most_ = 0.0;  ///< share that was told
};

}  // namespace flank::cli
