#include "flank/pipeline/program/operation_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "flank/error.h"
#include "flank/machine/nc/nc_number.h"

namespace flank::internal {
namespace {

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw UsageError("operations", text,
                   why +
                       "; expected NUMBER:KEY=VALUE,... with the keys name, tool, length (mm), spindle (1/min), feed "
                       "(mm/min) and flutes, as 2:name=finish,tool=7,spindle=12000");
}

double positive(std::string_view value, const std::string& text) {
  const auto number = leading_number(value);
  if (!number || number->length != value.size() || !(number->value > 0.0))
    refuse(text, "\"" + std::string(value) + "\" must be a number > 0");
  return number->value;
}

int whole(std::string_view value, const std::string& text) {
  const double number = positive(value, text);
  if (number != std::floor(number) || number > 1e6)
    refuse(text, "\"" + std::string(value) + "\" must be a whole number from 1 to 1000000");
  return static_cast<int>(number);
}

void set(std::string_view key, std::string_view value, const std::string& text, OperationWords& words) {
  if (key == "name" && !value.empty())
    words.name = value;
  else if (key == "tool")
    words.tool = whole(value, text);
  else if (key == "flutes")
    words.flutes = whole(value, text);
  else if (key == "length")
    words.length_mm = positive(value, text);
  else if (key == "spindle")
    words.spindle_rpm = positive(value, text);
  else if (key == "feed")
    words.feed_mm_min = positive(value, text);
  else
    refuse(text, "\"" + std::string(key) + "\" is not a key");
}

}  // namespace

std::vector<OperationWords> parse_operations(const std::vector<std::string>& texts, std::size_t count) {
  std::vector<OperationWords> all(count);
  for (const std::string& text : texts) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    const int number = whole(std::string_view(text).substr(0, colon), text);
    if (number > static_cast<int>(count)) refuse(text, "the program has " + std::to_string(count) + " operations");
    std::string_view rest = std::string_view(text).substr(std::min(colon + 1, text.size()));
    do {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      const std::string_view pair = rest.substr(0, comma);
      const std::size_t equals = std::min(pair.find('='), pair.size());
      set(pair.substr(0, equals), pair.substr(std::min(equals + 1, pair.size())), text,
          all[static_cast<std::size_t>(number) - 1]);
      rest.remove_prefix(std::min(comma + 1, rest.size()));
    } while (!rest.empty());
  }
  return all;
}

std::string heading(const NcOperation& operation) {
  std::string text = fmt::format("operation {} of {}", operation.number, operation.count);
  if (!operation.name.empty()) text += ", " + operation.name;
  if (operation.copies > 1) text += fmt::format(", copy {}", operation.copy);
  return text + ": ";
}

void add_under(const std::string& heading, const Acceptance& one, Acceptance& all) {
  for (const Shortfall& reason : one.reasons) all.reasons.push_back({reason.figure, heading + reason.text});
  for (const Shortfall& caution : one.cautions) all.cautions.push_back({caution.figure, heading + caution.text});
}

void require_operations(const std::string& file, const std::vector<NcProgram>& operations, std::size_t folders) {
  const auto operation = [](const NcProgram& p) { return p.header.operation.value_or(NcOperation{}); };
  const auto copies = static_cast<std::size_t>(operation(operations.front()).copies);
  if (operations.size() != folders * copies)
    throw InputError(fmt::format("{}: has {} operations{}; expected as many folders, in their order, and not {}", file,
                                 operations.size(), copies > 1 ? fmt::format(", {} copies of each", copies) : "",
                                 folders));
  for (std::size_t k = 0; k < operations.size(); ++k) {
    const NcOperation of = operation(operations[k]);
    if (static_cast<std::size_t>(of.copies) != copies || static_cast<std::size_t>(of.copy) != k % copies + 1)
      throw InputError(fmt::format("{}: operation {} is copy {} of {}; expected copy {} of {}", file, k + 1, of.copy,
                                   of.copies, k % copies + 1, copies));
  }
}

std::vector<std::size_t> folders_of(const std::string& file, const std::vector<NcProgram>& operations,
                                    std::size_t folders) {
  std::vector<std::size_t> out;
  for (std::size_t folder = 0; out.size() < operations.size(); ++folder) {
    const NcOperation first = operations[out.size()].header.operation.value_or(NcOperation{});
    for (int copy = 1; copy <= first.copies; ++copy) {
      const std::size_t k = out.size();
      const NcOperation of =
          k < operations.size() ? operations[k].header.operation.value_or(NcOperation{}) : NcOperation{.copy = 0};
      if (of.copy != copy || of.copies != first.copies)
        throw InputError(
            fmt::format("{}: operation {} is not copy {} of {}; expected all copies of an operation in a row", file,
                        k + 1, copy, first.copies));
      out.push_back(folder);
    }
  }
  if (out.empty() || out.back() + 1 != folders)
    throw InputError(
        fmt::format("{}: has {} operations, with their copies {}; expected as many folders, in their order, "
                    "and not {}",
                    file, out.empty() ? 0 : out.back() + 1, out.size(), folders));
  return out;
}

PostJob request_of(const PostJob& request, const std::string& folder, const OperationWords& words) {
  PostJob one = request;
  one.folder = folder;
  one.more_folders.clear();
  if (words.flutes) one.flutes = words.flutes;
  if (words.length_mm) one.tool_length_mm = words.length_mm;
  if (words.spindle_rpm) one.spindle_rpm = words.spindle_rpm;
  if (words.feed_mm_min) one.feed_mm_min = words.feed_mm_min;
  return one;
}

}  // namespace flank::internal
