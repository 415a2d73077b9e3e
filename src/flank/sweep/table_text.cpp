#include "flank/sweep/table_text.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

namespace flank::internal {
namespace {

constexpr const char* kStyle =
    "body{font:15px system-ui,sans-serif;margin:2em;color:#223}table{border-collapse:collapse;margin:1em 0 2em}"
    "th,td{border:1px solid #ccd;padding:.4em .7em;text-align:left}td small{color:#556}"
    ".meets{background:#e2f3e4}.short{background:#fdf0d5}.none{background:#f8dcdc}.caution{color:#8a5a00}.chosen{"
    "outline:2px solid #2a6}";

/// "-0.5", "+3", "-1e-9", and nothing behind it.
bool is_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

std::string csv_cell(const std::string& text) {
  const bool formula =
      !text.empty() && std::string_view("=+-@\t\r").find(text[0]) != std::string_view::npos && !is_number(text);
  if (!formula && text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = formula ? "\"'" : "\"";
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
