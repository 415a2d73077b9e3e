/// Links around the strips of a path, chosen until the judge finds that none of them cuts too deep.
#pragma once

#include "flank/job.h"
#include "flank/judge.h"
#include "flank/machine/links.h"
#include "flank/setup/setup.h"

namespace flank::internal {

struct JudgedLinks {
  KnownPath linked;     ///< link, strip, link, ..., link; nothing is known of the links
  VerifyReport report;  ///< of the links alone

  [[nodiscard]] Path links() const;
  /// The deepest that a link cuts, target or not.
  [[nodiscard]] double depth_mm() const;
};

/// Of the strips in their order, each left and entered by the first of its ways (link_lift.h) on which the judge finds no cut
/// deeper than the tolerance. A link that cuts is made again by the next way at that end, as often as is worth it; where none
/// is free the links that cut least are kept, and their report says so. `options` says what to keep out of and what the tool needs; its leads
/// are filled in here.
[[nodiscard]] JudgedLinks judged_links(const Setup& setup, const JudgeRequest& judge, const Tool& tool,
                                       const KnownPath& strips, LinkOptions options, double lift_mm);

}  // namespace flank::internal
