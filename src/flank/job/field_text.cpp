#include "flank/job/field_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "flank/error.h"

namespace flank::internal {
namespace {

/// All of the word as a number; a plus in front is no difference.
template <class T>
bool parse_number(const std::string& word, T& value) {
  const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  return error == std::errc() && stop == end && begin != end;
}

/// The table's own words of what is accepted come first, since they know the range.
[[noreturn]] void refuse(const FieldInfo& info, const std::string& word, std::string_view otherwise) {
  // "0.1mm": the unit is the option's, and is not written.
  if (const std::size_t unit = word.find_first_not_of("+-.0123456789");
      !info.unit.empty() && unit > 0 && unit < word.size())
    throw UsageError(field_name(info), word, fmt::format("expected a number of {} without a unit", info.unit));
  throw UsageError(field_name(info), word, std::string(info.accepted.words.empty() ? otherwise : info.accepted.words));
}

}  // namespace

std::string field_name(const FieldInfo& info) {
  std::string name(info.key);
  if (info.unit.empty()) return name;
  name += "_" + std::string(info.unit);
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

std::string flag_of(const FieldInfo& info) {
  if (!info.option.empty()) return std::string(info.option);
  std::string flag = "--" + std::string(info.key);
  std::replace(flag.begin(), flag.end(), '_', '-');
  return flag;
}

// Numbers by fmt: the shortest digits that read back as the same bits.
std::vector<std::string> field_words(const FieldInfo&, const std::string& value) { return {value}; }
std::vector<std::string> field_words(const FieldInfo&, double value) { return {fmt::format("{}", value)}; }
std::vector<std::string> field_words(const FieldInfo&, std::uint64_t value) { return {std::to_string(value)}; }
std::vector<std::string> field_words(const FieldInfo&, bool value) { return {value ? "on" : "off"}; }
std::vector<std::string> field_words(const FieldInfo&, const std::vector<std::string>& value) { return value; }
std::vector<std::string> field_words(const FieldInfo& info, int value) {
  if (info.spelling == Spelling::kSign) return {value < 0 ? "-" : "+"};
  if (info.spelling == Spelling::kAutoOrCount && value == 0) return {"auto"};
  return {std::to_string(value)};
}

// One overload a type: the table of fields calls the one of each member.
void read_word(const FieldInfo&, const std::string& word, std::string& value) { value = word; }
void read_word(const FieldInfo&, const std::string& word, std::vector<std::string>& value) { value.push_back(word); }

void read_word(const FieldInfo& info, const std::string& word, double& value) {
  if (!parse_number(word, value)) refuse(info, word, "expected a number");
}

void read_word(const FieldInfo& info, const std::string& word, std::uint64_t& value) {
  if (!parse_number(word, value)) refuse(info, word, "expected a whole number >= 0");
}

void read_word(const FieldInfo& info, const std::string& word, bool& value) {
  if (word != "on" && word != "off") refuse(info, word, "expected on or off");
  value = word == "on";
}

void read_word(const FieldInfo& info, const std::string& word, int& value) {
  if (info.spelling == Spelling::kSign) {
    if (word != "+" && word != "-") refuse(info, word, "expected + or -");
    value = word == "-" ? -1 : +1;
  } else if (info.spelling == Spelling::kAutoOrCount) {
    // 0 stands for auto in the job, but is no count.
    if (word == "auto")
      value = 0;
    else if (!parse_number(word, value) || value < 1)
      refuse(info, word, "expected auto or a number");
  } else if (!parse_number(word, value)) {
    refuse(info, word, "expected a whole number");
  }
}

}  // namespace flank::internal
