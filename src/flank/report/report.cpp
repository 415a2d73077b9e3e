#include "flank/report.h"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "flank/base/atomic_file.h"
#include "flank/base/rest_of.h"
#include "flank/base/sha256.h"
#include "flank/error.h"
#include "flank/manifest/folder_inputs.h"
#include "flank/manifest/result_folder.h"
#include "flank/report/page_template.h"
#include "flank/report/report_file.h"
#include "flank/version.h"

namespace flank {
using namespace internal;
namespace {

namespace fs = std::filesystem;

/// Replaces the first occurrence; a template without it is a fault of the build.
std::string replaced(std::string_view text, std::string_view what, std::string_view with) {
  const std::size_t at = text.find(what);
  if (at == std::string_view::npos) throw InternalError("the page has no place for " + std::string(what));
  return std::string(text.substr(0, at)) + std::string(with) + std::string(text.substr(at + what.size()));
}

/// The text of a file that is JSON of its schema; nothing if there is no such file.
std::optional<std::string> read_checked(const fs::path& file, const std::string& schema) {
  if (!fs::exists(file)) return std::nullopt;
  if (!fs::is_regular_file(file)) throw InputError(file.string() + ": is not a file");
  std::ifstream stream(file, std::ios::binary);
  const std::string text = rest_of(stream);
  if (!stream.good() && !stream.eof()) throw InputError(file.string() + ": cannot be read");
  check_report_file(text, file.string(), schema);
  return text;
}

/// "F1 of blade.step - OpenFlank", from the first file that names the part.
std::string title_of(const nlohmann::json& json) {
  const auto word = [&](const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  const std::string part = word("part");
  if (part.empty()) return "OpenFlank report";
  return word("faces") + " of " + fs::path(part).filename().string() + " - OpenFlank";
}

}  // namespace

const std::vector<std::string>& report_files() {
  static const std::vector<std::string> kFiles{"view.json", "verify.json", "summary.json", "motion.json"};
  return kFiles;
}

bool page_is_built() { return !page_template().empty(); }

std::string script_safe(std::string_view json) {
  std::string text;
  text.reserve(json.size());
  // "</script>" inside a string would end the element.
  for (char c : json) c == '<' ? text += "\\u003c" : text += c;
  return text;
}

std::string html_safe(std::string_view text) {
  std::string out;
  for (char c : text) switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  return out;
}

std::string fill_page(std::string_view page, std::string_view title, std::string_view data) {
  // The data last: it may hold anything, even the mark of another place.
  return replaced(replaced(page, kTitlePlace, html_safe(title)), kDataPlace, data);
}

namespace {

/// Throws InputError if the part that the verdict is about is there, and is another one by now.
void require_same_part(const ResultFolder& folder) {
  const std::string file = moved_with(*folder.manifest(), folder.path(), folder.manifest()->judged.file);
  if (!fs::is_regular_file(file)) return;
  std::ifstream stream(file, std::ios::binary);
  const std::string content = rest_of(stream);
  if (stream && sha256(content) != folder.manifest()->judged.sha256)
    throw InputError(file + ": has changed since the verdict in " + folder.path() +
                     " was made; run `flank fit` or `flank verify` again");
}

}  // namespace

std::string make_report(const std::string& folder) {
  if (!page_is_built())
    throw UsageError("this flank was built without the report page: " + std::string(page_is_missing()));
  const ResultFolder held(folder, ResultFolder::Use::kRead);
  held.require_there({"job.json", "tool.json", "path.json", "verify.json", "summary.json", "view.json"});
  held.require_whole();
  if (held.manifest()) require_same_part(held);
  std::string data = std::string("<meta name=\"generator\" content=\"OpenFlank ") + kVersion + "\">\n", title;
  // The page says it: nothing ties files together that no manifest names.
  data += std::string("<meta name=\"flank-manifest\" content=\"") + (held.manifest() ? "whole" : "none") + "\">\n";
  bool found = false;
  for (const std::string& name : report_files()) {
    const auto text = read_checked(fs::path(folder) / name, schema_of(name));
    if (!text) continue;
    if (title.empty()) title = title_of(nlohmann::json::parse(*text));
    found = true;
    data += "<script type=\"application/json\" data-file=\"" + name + "\">" + script_safe(*text) + "</script>\n";
  }
  if (!found)
    throw InputError(folder +
                     ": contains none of view.json, verify.json, summary.json; give a folder written by `flank fit`");
  return fill_page(page_template(), title, data);
}

std::string write_report(const std::string& folder, const std::string& file) {
  const std::string page_file = file.empty() ? (fs::path(folder) / kPageFile).string() : file;
  require_not_a_result(folder, page_file);
  require_no_result_there(page_file);
  const ReadFiles inputs = inputs_of_folder(folder);
  const Unwritten unwritten(inputs);
  require_unread(page_file);
  const std::string page = make_report(folder);
  if (file.empty()) {
    ResultFolder held(folder, ResultFolder::Use::kWriteOrRead);
    held.require_own(kPageFile);
    if (held.manifest() && held.writable()) {
      held.add({{kPageFile, page}}, *held.manifest());
      return page_file;
    }
  }
  write_file(page_file, page);
  return page_file;
}

}  // namespace flank
