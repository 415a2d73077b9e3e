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

struct PictureOptions {
  int width = 1600, height = 1000;  ///< of the window, pixels
  std::string fragment;             ///< after the page's #: "theme=dark", "at=0.5"
};

/// Makes a PNG of an HTML file. Throws UsageError if no browser is installed, InternalError if it makes no picture.
void make_picture(const std::string& html_file, const std::string& png_file, const PictureOptions& options = {});

/// Hands a file to the user's browser (xdg-open) and returns. Throws UsageError if there is no way to open one.
void open_page(const std::string& html_file);

}  // namespace flank::internal
