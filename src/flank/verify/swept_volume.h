/// What a SweptVolume (flank/judge.h) holds: tool and path, prepared once for any number of searches.
#pragma once

#include <memory>

#include "flank/judge.h"
#include "flank/verify/swept/pose_tree.h"
#include "flank/verify/swept/swept_search.h"
#include "flank/verify/swept/tool_distance.h"

/// Immutable after construction. Searches know places by piece (SweptPlace), callers by strip and pose (SweptDistance).
struct flank::SweptVolume::Data {
  Tool tool;
  std::shared_ptr<const internal::verify::ToolDistance> distance;
  internal::verify::PoseTree tree;

  /// Throws InputError as SweptVolume does.
  Data(const Tool& t, std::shared_ptr<const internal::verify::ToolDistance> of_tool, const Path& path);

  /// One query, about x, which must outlive it.
  [[nodiscard]] internal::verify::SweptSearch search(const Vec3& x) const { return {*distance, tree, x}; }
  /// Where searches about points within `spread` of x begin that ask for nothing above `horizon`: f at these points is at most
  /// that of the ball of `near`.
  [[nodiscard]] std::vector<int> roots(const Vec3& x, double spread, double horizon,
                                       const internal::verify::SweptPlace& near) const;
  /// What a search found for x, in terms of the path; f by the tool's own radial function, not by the search's table. Strip
  /// -1 where it found nothing below its horizon.
  [[nodiscard]] SweptDistance at(const Vec3& x, const internal::verify::SweptPlace& place) const;
  /// A place of the path (strip >= 0) in terms of the tree.
  [[nodiscard]] internal::verify::SweptPlace find(const SweptDistance& place) const;
};
