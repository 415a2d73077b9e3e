/// What a SweptVolume (flank/judge.h) holds: tool and path, prepared once for any number of searches.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "flank/judge.h"
#include "flank/verify/swept/path_copies.h"
#include "flank/verify/swept/pose_tree.h"
#include "flank/verify/swept/swept_search.h"
#include "flank/verify/swept/tool_distance.h"

namespace flank::internal::verify {

/// A place of the path: the copy, and where it is in the tree.
struct CopyPlace {
  int copy = 0;
  SweptPlace place;
};
/// Where a search in one copy begins.
struct CopyRoots {
  int copy = 0;
  double least = 0.0;  ///< no place of this copy has a lower f there
  std::vector<int> nodes;
};

}  // namespace flank::internal::verify

/// Immutable after construction. Searches know places by copy and piece, callers by strip and pose (SweptDistance).
struct flank::SweptVolume::Data {
  Tool tool;
  std::shared_ptr<const internal::verify::ToolDistance> distance;
  internal::verify::PathCopies copies;
  internal::verify::PoseTree tree;  ///< of the first copy

  /// Throws InputError as SweptVolume does.
  Data(const Tool& t, std::shared_ptr<const internal::verify::ToolDistance> of_tool, const Path& path);

  /// The least f below `horizon`; `near` (piece -1: none) is looked at first.
  [[nodiscard]] internal::verify::CopyPlace nearest(const Vec3& x, double horizon,
                                                    const internal::verify::CopyPlace& near,
                                                    const std::vector<internal::verify::CopyRoots>& roots) const;
  /// Where searches about points within `spread` of x begin that ask for nothing above `horizon`, copies that may be nearer first.
  [[nodiscard]] std::vector<internal::verify::CopyRoots> roots(const Vec3& x, double spread, double horizon,
                                                               const internal::verify::CopyPlace& near) const;
  /// The same from the roots of all copies that may be nearer.
  [[nodiscard]] internal::verify::CopyPlace nearest(const Vec3& x, double horizon,
                                                    const internal::verify::CopyPlace& near) const;
  /// Copies with a place below `horizon`, perhaps, the lowest first, and what is no higher than any of theirs. Valid until the next is
  /// asked for by this thread.
  [[nodiscard]] const std::vector<std::pair<double, int>>& near_copies(const Vec3& x, double horizon) const;
  /// Takes a better place than the best one, if this copy has one below these nodes.
  void search_copy(const Vec3& x, int copy, std::span<const int> nodes, const internal::verify::CopyPlace& near,
                   internal::verify::CopyPlace& best) const;
  /// x as the first copy has it that stands for `copy`.
  [[nodiscard]] Vec3 turned_back(const Vec3& x, int copy) const { return turn(copy).back * x; }
  [[nodiscard]] const internal::verify::Turn& turn(int copy) const {
    return copies.turns[static_cast<std::size_t>(copy)];
  }
  /// What a search found for x, in terms of the path; f by the tool's own radial function, not by the search's table. Strip
  /// -1 where it found nothing below its horizon.
  [[nodiscard]] SweptDistance at(const Vec3& x, const internal::verify::CopyPlace& found) const;
  /// A place of the path (strip >= 0) in terms of the tree.
  [[nodiscard]] internal::verify::CopyPlace find(const SweptDistance& place) const;
};
