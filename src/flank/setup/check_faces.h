/// Which of a part's other faces are check surfaces: faces that the tool must not enter.
#pragma once

#include <string>
#include <vector>

#include "flank/job.h"
#include "flank/part.h"

namespace flank::internal {

/// Indices of the part's check faces, ascending; `targets` are indices too. If the request names none, every face that is
/// no target is one. Throws UsageError naming the field for a
/// face that the part does not have (and those that it has), for a target, and for a face that is named twice or in
/// both lists.
[[nodiscard]] std::vector<int> faces_to_check(const Part& part, const std::vector<int>& targets,
                                              const ObstacleRequest& request);

/// Indices of the faces that are in the file and could not be read, and that the request does not name among those to
/// ignore: nothing is known of what enters them. Throws UsageError as faces_to_check does.
[[nodiscard]] std::vector<int> faces_unread(const Part& part, const std::vector<int>& targets,
                                            const ObstacleRequest& request);

/// What to tell the user about faces that are left out; empty if there are none.
[[nodiscard]] std::string unchecked_note(const Part& part, const std::vector<int>& targets,
                                         const std::vector<int>& checks, const std::vector<int>& unread);

/// Where check faces are of other solids than the targets (an assembly): that they are, and how to leave them out. Empty if none is.
[[nodiscard]] std::string other_solids_note(const Part& part, const std::vector<int>& targets,
                                            const std::vector<int>& checks);

}  // namespace flank::internal
