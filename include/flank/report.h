/// `flank report DIR`: the files of a folder packed into one HTML page that needs nothing else. It computes nothing.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flank {

/// Files that the page reads, in the order in which they are packed.
[[nodiscard]] const std::vector<std::string>& report_files();

/// Whether the library holds the page: it is built where npm is (FLANK_REPORT).
[[nodiscard]] bool page_is_built();

/// The page of what lies in `folder`. A file that is missing is left out, and the page says so. Throws UsageError if the
/// library was built without the page; InputError if there is no such folder, if it holds none of the files, if one of
/// them is no JSON of the schema that belongs to it, and if files or part are not those of manifest.json.
[[nodiscard]] std::string make_report(const std::string& folder);

/// Writes that page to `file`, or to report.html in the folder if it is empty: there it belongs to the result, so that it
/// goes when a new one comes. The file's name. Throws as make_report, and InputError if `file` is one of the result's own
/// or cannot be written.
std::string write_report(const std::string& folder, const std::string& file = {});

/// How a picture of a page is taken.
struct PictureOptions {
  int width = 1600, height = 1000;  ///< of the window, pixels
  std::string fragment;             ///< after the page's #: "theme=dark", "at=0.5"
};
/// Makes a PNG of an HTML file with the browser that is installed. Throws UsageError if none is, InternalError if it makes no
/// picture.
void make_picture(const std::string& html_file, const std::string& png_file, const PictureOptions& options = {});
/// Hands a file, or an address that begins with http://, to the user's browser (xdg-open) and returns. Throws UsageError if there is no way to open one.
void open_page(const std::string& html_file);

/// A page from a given template: title and data are put in their places.
[[nodiscard]] std::string fill_page(std::string_view page, std::string_view title, std::string_view data);

/// JSON that may stand inside a script element: no "<" is left, and the value is the same.
[[nodiscard]] std::string script_safe(std::string_view json);

/// Text that may stand inside an HTML element.
[[nodiscard]] std::string html_safe(std::string_view text);

}  // namespace flank
