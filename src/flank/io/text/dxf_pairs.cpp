#include "flank/io/text/dxf_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "flank/error.h"

namespace flank::internal {
namespace {

/// $INSUNITS: what one unit of the drawing is, mm.
double unit_of_drawing(int code, const DxfPairs& in) {
  constexpr std::array<std::pair<int, double>, 9> kUnits = {
      {{0, 1.0}, {1, 25.4}, {2, 304.8}, {4, 1.0}, {5, 10.0}, {6, 1000.0}, {8, 25.4e-6}, {9, 0.0254}, {13, 1e-3}}};
  for (const auto& [number, size] : kUnits)
    if (number == code) return size;
  in.refuse(
      fmt::format("$INSUNITS {} is not a unit of a tool's drawing; accepted: mm, cm, m, um, inches, feet, mils", code));
}

int whole_number(std::string_view text, const DxfPairs& in) {
  int value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size())
    in.refuse(fmt::format("\"{}\" is not a whole number", std::string(text.substr(0, 40))));
  return value;
}

}  // namespace

bool DxfPairs::next() {
  std::string_view code;
  if (!take_line(code)) return false;
  const auto [stop, error] = std::from_chars(code.data(), code.data() + code.size(), code_);
  if (error != std::errc() || stop != code.data() + code.size())
    refuse(line_ == 1 ? "is not an ASCII DXF, which begins with a group code"
                      : fmt::format("\"{}\" is not a group code", std::string(code.substr(0, 40))));
  if (!take_line(value_)) refuse("the file ends after a group code");
  return true;
}

void DxfPairs::refuse(const std::string& why) const {
  throw InputError(fmt::format("{}: line {}: {}", file_, line_, why));
}

/// The next line without blanks around it.
bool DxfPairs::take_line(std::string_view& out) {
  if (at_ >= text_.size()) return false;
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  out = text_.substr(at_, end - at_);
  at_ = end + 1;
  ++line_;
  const std::size_t first = out.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) {
    out = {};
    return at_ < text_.size();  // blank lines at the end are not a pair
  }
  out = out.substr(first, out.find_last_not_of(" \t\r") - first + 1);
  return true;
}

bool DxfRecord::has(int code) const {
  return std::any_of(groups.begin(), groups.end(), [code](const auto& group) { return group.first == code; });
}

std::string DxfRecord::text(int code, const std::string& missing) const {
  for (const auto& [number, value] : groups)
    if (number == code) return value;
  return missing;
}

DxfContent read_dxf(std::string_view text, const std::string& file) {
  DxfPairs in(text, file);
  DxfContent content;
  std::string section, variable;
  bool section_starts = false;
  while (in.next()) {
    const std::string value(in.value());
    if (in.code() == 0) {
      section_starts = value == "SECTION";
      if (value == "ENDSEC") section.clear();
      if (section == "ENTITIES") content.entities.push_back({value, in.line(), {}});
    } else if (section_starts && in.code() == 2) {
      section = value;
      section_starts = false;
    } else if (section == "HEADER") {
      if (in.code() == 9) variable = value;
      if (in.code() == 70 && variable == "$INSUNITS") content.unit_mm = unit_of_drawing(whole_number(value, in), in);
    } else if (section == "ENTITIES" && !content.entities.empty()) {
      content.entities.back().groups.emplace_back(in.code(), value);
    }
  }
  return content;
}

}  // namespace flank::internal
