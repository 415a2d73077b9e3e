/// The page of `flank report` as it was built into the library (web/), with places for the title and the data.
#pragma once

#include <string_view>

namespace flank::internal {

/// The whole HTML file; empty where the library was built without the page.
[[nodiscard]] std::string_view page_template();

/// What was lacking when the library was built without it, for people.
[[nodiscard]] std::string_view page_is_missing();

inline constexpr std::string_view kTitlePlace = "<!--FLANK_TITLE-->";
inline constexpr std::string_view kDataPlace = "<!--FLANK_DATA-->";

}  // namespace flank::internal
