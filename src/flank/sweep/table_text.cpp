#include "flank/sweep/table_text.h"

#include <fmt/format.h>

namespace flank::internal {
namespace {

constexpr const char* kStyle =
    "body{font:15px system-ui,sans-serif;margin:2em;color:#223}table{border-collapse:collapse;margin:1em 0 2em}"
    "th,td{border:1px solid #ccd;padding:.4em .7em;text-align:left}td small{color:#556}"
    ".meets{background:#e2f3e4}.short{background:#fdf0d5}.none{background:#f8dcdc}.caution{color:#8a5a00}.chosen{"
    "outline:2px solid #2a6}";

}  // namespace

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string html_head(const std::string& title) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<meta "
      "charset=\"utf-8\">\n<title>{}</title>\n<style>{}</style>\n<h1>{}</h1>\n",
      title, kStyle, title);
}

}  // namespace flank::internal
