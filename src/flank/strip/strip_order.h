/// The order and the direction in which strips are machined: short links between them.
#pragma once

#include <vector>

#include "flank/ruled_motion.h"

namespace flank::internal {

/// Same envelope, run the other way.
[[nodiscard]] RuledMotion reversed(const RuledMotion& motion);

/// Length of a link, mm: the mean way of both ends of the axis from the last pose of one to the first of the next.
[[nodiscard]] double link_length(const RuledMotion& from, const RuledMotion& to);
[[nodiscard]] double link_length(const std::vector<RuledMotion>& motions);

/// The motions in an order, each in a direction, whose links are short: nearest neighbours from every possible start,
/// then stretches reversed while that shortens (2-opt). Deterministic.
[[nodiscard]] std::vector<RuledMotion> ordered(const std::vector<RuledMotion>& motions);

/// The same as indices into `motions`; `turned` says which run the other way.
struct StripOrder {
  std::vector<std::size_t> index;
  std::vector<char> turned;
};
[[nodiscard]] StripOrder strip_order(const std::vector<RuledMotion>& motions);

}  // namespace flank::internal
