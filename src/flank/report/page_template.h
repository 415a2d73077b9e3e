/// The pages of web/ as they were built into the library, with places for the title and the data.
#pragma once

#include <string_view>

namespace flank::internal {

/// The whole HTML file of `flank report`; empty where the library was built without the pages.
[[nodiscard]] std::string_view page_template();
/// Of `flank inspect --html`, and of `flank studio`.
[[nodiscard]] std::string_view faces_template();
[[nodiscard]] std::string_view studio_template();

/// What was lacking when the library was built without them, for people.
[[nodiscard]] std::string_view page_is_missing();

inline constexpr std::string_view kTitlePlace = "<!--FLANK_TITLE-->";
inline constexpr std::string_view kDataPlace = "<!--FLANK_DATA-->";

}  // namespace flank::internal
