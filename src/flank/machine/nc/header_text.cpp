#include "flank/machine/nc/header_text.h"

#include <charconv>

#include "flank/machine/nc/nc_number.h"

namespace flank::internal {

namespace {

constexpr int kHeaderDecimals = 6;  // of mm: a nanometre, so that what is read back is the same tool

/// What follows the keyword and a space; nothing if the text does not begin with them.
std::optional<std::string_view> after(std::string_view text, std::string_view keyword) {
  if (text.size() <= keyword.size() || !text.starts_with(keyword) || text[keyword.size()] != ' ') return std::nullopt;
  return text.substr(keyword.size() + 1);
}

/// Takes the first word off the text.
std::string_view take_word(std::string_view& text) {
  const std::size_t end = std::min(text.find(' '), text.size());
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return word;
}

/// The word as a whole number; nothing if anything else stands in it.
std::optional<int> whole(std::string_view word) {
  int value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// The value after "KEYWORD " where the text begins with it; takes both off.
std::optional<double> take_value(std::string_view& text, std::string_view keyword) {
  const auto rest = after(text, keyword);
  if (!rest) return std::nullopt;
  const auto number = leading_number(*rest);
  if (!number || number->value < 0.0) return std::nullopt;
  text = rest->substr(number->length);
  if (text.starts_with(' ')) text.remove_prefix(1);
  return number->value;
}

/// "DIAMETER d LENGTH l TIP OFFSET o", mm. All three or none: a line that is not ours changes nothing.
bool read_dimensions(std::string_view text, NcTool& tool) {
  const auto diameter = take_value(text, "DIAMETER");
  const auto length = take_value(text, "LENGTH");
  const auto offset = take_value(text, "TIP OFFSET");
  if (!diameter || !length || !offset || !text.empty()) return false;
  tool.diameter = *diameter;
  tool.length = *length;
  tool.tip_offset = *offset;
  return true;
}

/// A word of a comment: no spaces, never empty.
std::string one_word(std::string_view text) {
  std::string word = safe_comment(text);
  for (char& c : word)
    if (c == ' ') c = '_';
  return word.empty() ? "-" : word;
}

}  // namespace

std::string safe_comment(std::string_view name) {
  constexpr std::string_view kSpecial = "%~$\"";
  std::string out(name.substr(0, kLongestNcComment));
  for (char& c : out) {
    if (c == '(') c = '[';
    if (c == ')') c = ']';
    if (c == ';') c = ',';
    if (c < ' ' || c > '~' || kSpecial.find(c) != std::string_view::npos) c = '_';
  }
  // Readers trim comments: the name that is read back is then the one that was written.
  while (out.ends_with(' ')) out.pop_back();
  return out;
}

std::vector<std::string> header_comments(const NcHeader& header) {
  std::vector<std::string> comments;
  if (header.operation) comments.push_back(operation_comment(*header.operation));
  if (!header.copy_axis.empty()) comments.push_back(safe_comment("COPIES ABOUT " + header.copy_axis));
  if (!header.part.empty()) comments.push_back(safe_comment("PART " + header.part));
  if (!header.machine.empty()) comments.push_back(safe_comment("MACHINE " + header.machine));
  if (!header.setup.empty()) comments.push_back(safe_comment("SETUP " + header.setup));
  if (!header.origin.empty())
    comments.push_back(safe_comment("WORK OFFSET " + std::to_string(header.work_offset) + " HOLDS " + header.origin));
  const NcTool& tool = header.tool;
  // Two lines for the tool: its name may be long, and its dimensions must not be cut off with it.
  std::string named = "TOOL " + std::to_string(tool.number);
  if (!tool.name.empty()) named += " " + tool.name;
  comments.push_back(safe_comment(named));
  std::string size = "TOOL DIAMETER ";
  append_decimal(size, tool.diameter, kHeaderDecimals);
  append_decimal(size += " LENGTH ", tool.length, kHeaderDecimals);
  append_decimal(size += " TIP OFFSET ", tool.tip_offset, kHeaderDecimals);
  comments.push_back(size);
  if (header.dry_run) comments.emplace_back(kStandsStill);
  for (const std::string& text : header.shortfalls) comments.push_back(safe_comment(std::string(kFallsShort) + text));
  for (const std::string& text : header.cautions) comments.push_back(safe_comment(std::string(kCaution) + text));
  return comments;
}

namespace {

/// Takes what a comment says, unless an earlier one has said something else.
template <class T>
void state(std::optional<T>& known, const T& said, std::string_view what, NcHeader& header) {
  if (known && *known != said && header.stated.contradiction.empty())
    header.stated.contradiction = "its comments name two different values of " + std::string(what);
  if (!known) known = said;
}
void state(std::string& known, std::string_view said, std::string_view what, NcHeader& header) {
  if (!known.empty() && known != said && header.stated.contradiction.empty())
    header.stated.contradiction = "its comments name two different values of " + std::string(what);
  if (known.empty()) known = said;
}

/// "n HOLDS X.. Y.. Z.."; its number is what the program was made for, not the program's own word.
bool read_offset(std::string_view text, NcHeader& header) {
  const auto number = whole(take_word(text));
  if (!number || !text.starts_with("HOLDS ")) return false;
  state(header.stated.work_offset, *number, "WORK OFFSET", header);
  state(header.origin, text.substr(6), "HOLDS", header);
  return true;
}

/// "n name". Both lines of the tool begin with TOOL; a number follows in this one only.
bool read_tool(std::string_view text, NcHeader& header) {
  const auto number = whole(take_word(text));
  // No T word could say a larger one.
  if (!number || *number < 0 || *number > kLargestNcValue) return false;
  state(header.stated.tool, *number, "TOOL", header);
  header.stated.tool_name = text;
  header.tool.number = *number;
  header.tool.name = text;
  return true;
}

}  // namespace

bool read_header_comment(std::string_view comment, NcHeader& header) {
  if (const auto part = after(comment, "PART")) {
    header.part = *part;
  } else if (const auto machine = after(comment, "MACHINE")) {
    state(header.machine, *machine, "MACHINE", header);
  } else if (const auto setup = after(comment, "SETUP")) {
    state(header.setup, *setup, "SETUP", header);
  } else if (const auto offset = after(comment, "WORK OFFSET")) {
    return read_offset(*offset, header);
  } else if (const auto axis = after(comment, "COPIES ABOUT")) {
    state(header.copy_axis, *axis, "COPIES ABOUT", header);
  } else if (const auto tool = after(comment, "TOOL")) {
    return read_dimensions(*tool, header.tool) || read_tool(*tool, header);
  } else {
    if (comment.find(kDryRun) == std::string_view::npos) return false;
    header.stated.dry_run = true;
  }
  return true;
}

std::string operation_comment(const NcOperation& operation) {
  std::string text = "OPERATION " + std::to_string(operation.number) + " OF " + std::to_string(operation.count);
  if (operation.copies > 1)
    text += " COPY " + std::to_string(operation.copy) + " OF " + std::to_string(operation.copies);
  if (!operation.name.empty()) text += " " + operation.name;
  return safe_comment(text);
}

std::optional<NcOperation> read_operation_comment(std::string_view comment) {
  auto rest = after(comment, "OPERATION");
  if (!rest) return std::nullopt;
  // "k OF n": of both, and of nothing else, a number of which k is one.
  const auto pair = [&](int& which, int& count) {
    const auto k = whole(take_word(*rest));
    const bool of = take_word(*rest) == "OF";
    const auto n = whole(take_word(*rest));
    if (!k || !of || !n || *k < 1 || *k > *n || *n > kMostOperations) return false;
    which = *k;
    count = *n;
    return true;
  };
  NcOperation operation;
  if (!pair(operation.number, operation.count)) return std::nullopt;
  if (rest->starts_with("COPY ")) {
    const std::string_view name = *rest;
    take_word(*rest);
    // Else it is a name that begins with COPY.
    if (!pair(operation.copy, operation.copies)) rest = name;
  }
  operation.name = *rest;
  return operation;
}

std::string strip_comment(const NcStrip& strip) {
  std::string text = "STRIP " + std::to_string(strip.id) + " " + one_word(strip.kind);
  // One word each, so that reading back can split at blanks.
  if (!strip.face.empty()) text += " " + one_word(strip.face);
  return safe_comment(text);
}

std::optional<NcStrip> read_strip_comment(std::string_view comment) {
  auto rest = after(comment, "STRIP");
  if (!rest) return std::nullopt;
  const auto id = whole(take_word(*rest));
  if (!id) return std::nullopt;
  const std::string_view kind = take_word(*rest);
  if (kind.empty()) return std::nullopt;
  return NcStrip{*id, std::string(kind), std::string(*rest)};
}

}  // namespace flank::internal
