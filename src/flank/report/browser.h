/// The browser: to show a page to the user, and to make a picture of one.
#pragma once

#include <string>
#include <vector>

namespace flank::internal {

/// Programs that can make a picture of a page, in the order in which they are looked for in PATH; FLANK_BROWSER of the
/// environment comes before them.
[[nodiscard]] const std::vector<std::string>& browsers();

/// The first of them that is there; empty if none is.
[[nodiscard]] std::string find_browser();

}  // namespace flank::internal
