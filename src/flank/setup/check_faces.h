/// Which of a part's other faces are check surfaces: faces that the tool must not enter.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/part.h"

namespace flank::internal {

/// What the user chose. Neither given: every face that is no target is a check surface.
struct CheckFaceChoice {
  std::optional<std::string> only;     ///< "F88,F12": these alone
  std::optional<std::string> ignored;  ///< "F5": all but these

  [[nodiscard]] bool any() const { return only || ignored; }
};

/// Indices of the part's check faces, ascending; `targets` are indices too. Throws UsageError naming the option for a
/// face that the part does not have (and those that it has), for a target, and for a face that is named twice or in
/// both lists.
[[nodiscard]] std::vector<int> faces_to_check(const Part& part, const std::vector<int>& targets,
                                              const CheckFaceChoice& choice);

/// What to tell the user about faces that are left out; empty if there are none.
[[nodiscard]] std::string unchecked_note(const Part& part, const std::vector<int>& targets,
                                         const std::vector<int>& checks);

}  // namespace flank::internal
