/// What pages and tables of many results share.
#pragma once

#include <string>

namespace flank::internal {

/// A value in quotes if a comma, a quote or a line's end is in it. Text that a spreadsheet would take for a formula (it begins
/// with = + - @, a tab or a carriage return) is in quotes behind an apostrophe; a number stays a number.
[[nodiscard]] std::string csv_cell(const std::string& text);

/// The beginning of a page, up to its heading; the title is HTML already.
[[nodiscard]] std::string html_head(const std::string& title);

}  // namespace flank::internal
