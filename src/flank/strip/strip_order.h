/// The order and the direction in which strips are machined: short links between them.
///
/// Neither changes what is cut: the envelope of a motion is the same run backwards.
#pragma once

#include <vector>

#include "flank/ruled_motion.h"

namespace flank::internal {

/// The same motion run the other way: reversed(m).pose(t) = m.pose(1 - t), exactly up to round-off. The same envelope.
[[nodiscard]] RuledMotion reversed(const RuledMotion& motion);

/// Length of a link, mm: the mean distance that both ends of the axis go in a straight line from the last pose of one
/// motion to the first of the next. No retract is in it: it compares orders, it is no quotation of time.
[[nodiscard]] double link_length(const RuledMotion& from, const RuledMotion& to);
/// Sum over the links between the motions in their order; 0 for fewer than two.
[[nodiscard]] double link_length(const std::vector<RuledMotion>& motions);

/// The motions in an order, each in a direction, whose links are short: nearest neighbours from every possible start,
/// then stretches reversed while that shortens (2-opt): short, not always the shortest. Deterministic. Time grows with
/// the fourth power of their number or so; there are seldom more than a dozen.
[[nodiscard]] std::vector<RuledMotion> ordered(const std::vector<RuledMotion>& motions);

/// The same as indices into `motions`.
struct StripOrder {
  std::vector<std::size_t> index;  ///< a permutation
  std::vector<char> turned;        ///< of each place in the order: 1 if that motion runs the other way
};
[[nodiscard]] StripOrder strip_order(const std::vector<RuledMotion>& motions);

}  // namespace flank::internal
