#include "flank/io/text/json_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>

#include "flank/error.h"

namespace flank::internal {

namespace {

using nlohmann::json;

/// Bytes. More is a wrong file, and its document would need several times as much memory.
constexpr std::uintmax_t kLargestFile = 512u << 20;
/// Far more than any of our files needs; a document that is deeper could exhaust the stack.
constexpr int kDeepestNesting = 64;

/// The parser's message without its internal prefix "[json.exception.parse_error.101] parse error at ".
std::string plain_message(const json::exception& e) {
  std::string message = e.what();
  if (const std::size_t at = message.find("] "); at != std::string::npos) message.erase(0, at + 2);
  if (message.rfind("parse error at ", 0) == 0) message.erase(0, std::string("parse error at ").size());
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message;
}

/// Watches the parse: the parser itself would silently keep the last of two equal keys.
class DuplicateKeys {
 public:
  explicit DuplicateKeys(std::string file) : file_(std::move(file)) {}

  bool operator()(int depth, json::parse_event_t event, json& parsed) {
    if (depth > kDeepestNesting) throw InputError(file_ + ": nested too deep");
    if (event == json::parse_event_t::object_start) keys_.emplace_back();
    if (event == json::parse_event_t::object_end && !keys_.empty()) keys_.pop_back();
    if (event == json::parse_event_t::key && !keys_.empty() && !keys_.back().insert(parsed.get<std::string>()).second)
      throw InputError(file_ + ": key \"" + parsed.get<std::string>() + "\" occurs twice");
    return true;
  }

 private:
  std::string file_;
  std::vector<std::set<std::string>> keys_;
};

/// Shared: members and elements keep the document alive that they are part of. `end_of` is asked of every object that ends, with its depth and
/// the key at the top that it stands under; those that it says no to are left out.
std::shared_ptr<const json> parse(const std::string& file, std::string_view text,
                                  const std::function<bool(int depth, const std::string& top, json&)>& end_of) {
  try {
    DuplicateKeys watch(file);
    std::string top;
    const json::parser_callback_t callback = [&](int depth, json::parse_event_t event, json& parsed) {
      if (event == json::parse_event_t::key && depth == 1) top = parsed.get<std::string>();
      return watch(depth, event, parsed) && (event != json::parse_event_t::object_end || end_of(depth, top, parsed));
    };
    return std::make_shared<const json>(json::parse(text.begin(), text.end(), callback));
  } catch (const json::exception& e) {
    throw InputError(file + ": not valid JSON, " + plain_message(e));
  }
}

std::shared_ptr<const json> parse(const std::string& file, std::string_view text) {
  return parse(file, text, [](int, const std::string&, json&) { return true; });
}

/// How many of the numbers of an array that is as long are finite ones, up to the first that is none.
std::size_t read_numbers(const json& array, std::span<double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const json& value = array[i];
    values[i] = value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
    if (!std::isfinite(values[i])) return i;
  }
  return values.size();
}

}  // namespace

std::string read_file(const std::string& file) {
  std::error_code error;
  // Each with its own message: "cannot be read" alone leaves the user guessing.
  if (!std::filesystem::exists(file, error)) throw InputError(file + ": no such file");
  if (!std::filesystem::is_regular_file(file, error)) throw InputError(file + ": is not a file");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) throw InputError(file + ": cannot be read");
  if (size == 0) throw InputError(file + ": is empty");
  if (size > kLargestFile) throw InputError(file + ": is larger than 512 MB");
  std::ifstream in(file, std::ios::binary);
  std::string content(static_cast<std::size_t>(size), '\0');
  if (!in.read(content.data(), static_cast<std::streamsize>(content.size())))
    throw InputError(file + ": cannot be read");
  return content;
}

JsonInput::JsonInput(const std::string& file, std::string_view text)
    : document_(parse(file, text)), value_(document_.get()), file_(file) {
  if (!value_->is_object()) refuse("must be a JSON object {...}");
}

JsonInput::JsonInput(const std::string& file, std::string_view text, const std::string& list,
                     const std::function<void(const JsonInput&)>& each)
    : file_(file) {
  constexpr int kElementDepth = 2;  // the document, the list, its elements
  std::size_t number = 0;
  document_ = parse(file, text, [&](int depth, const std::string& top, json& parsed) {
    if (depth != kElementDepth || top != list) return true;
    auto element = std::make_shared<const json>(std::move(parsed));
    const json& value = *element;
    each(JsonInput(std::move(element), value, file, fmt::format("{}[{}]", list, number++)));
    return false;
  });
  value_ = document_.get();
  if (!value_->is_object()) refuse("must be a JSON object {...}");
}

void JsonInput::refuse(const std::string& why) const {
  throw InputError(file_ + ": " + (place_.empty() ? "" : place_ + ": ") + why);
}

void JsonInput::require_schema(std::string_view schema) const {
  // Before anything else is read, so that another kind of file is named as such and not by some missing key.
  if (!has("schema")) refuse(fmt::format("no \"schema\"; accepted: \"{}\"", schema));
  const std::string found = member("schema").text();
  if (found != schema) member("schema").refuse(fmt::format("is \"{}\"; accepted: \"{}\"", found, schema));
  // "units" may be left out, but must not contradict.
  if (has("units") && member("units").text() != "mm")
    member("units").refuse(fmt::format("is \"{}\"; accepted: \"mm\"", member("units").text()));
}

void JsonInput::allow_keys(std::initializer_list<std::string_view> known) const {
  for (const std::string& key : keys())
    if (std::find(known.begin(), known.end(), key) == known.end())
      refuse(fmt::format("unknown key \"{}\"; accepted: {}", key, fmt::join(known, ", ")));
}

bool JsonInput::has(std::string_view key) const { return value_->is_object() && value_->contains(std::string(key)); }

JsonInput JsonInput::member(std::string_view key) const {
  if (!value_->is_object()) refuse("must be an object {...}");
  const auto found = value_->find(std::string(key));
  if (found == value_->end()) refuse(fmt::format("\"{}\" is missing", key));
  return {document_, *found, file_, place_.empty() ? std::string(key) : fmt::format("{}.{}", place_, key)};
}

std::size_t JsonInput::size() const {
  if (!value_->is_array()) refuse("must be an array [...]");
  return value_->size();
}

JsonInput JsonInput::element(std::size_t i) const {
  if (i >= size()) refuse("is too short");
  return {document_, (*value_)[i], file_, fmt::format("{}[{}]", place_, i)};
}

std::vector<std::string> JsonInput::keys() const {
  if (!value_->is_object()) refuse("must be an object {...}");
  std::vector<std::string> names;
  for (const auto& item : value_->items()) names.push_back(item.key());
  return names;
}

bool JsonInput::is_array() const { return value_->is_array(); }

double JsonInput::number() const {
  if (!value_->is_number()) refuse("must be a number");
  const double value = value_->get<double>();
  if (!std::isfinite(value)) refuse("must be a finite number");
  return value;
}

double JsonInput::positive() const {
  const double value = number();
  if (!(value > 0.0)) refuse(fmt::format("is {}; must be > 0", value));
  return value;
}

/// 3.0 is a whole number in JSON.
int JsonInput::integer() const {
  const double value = number();
  if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max()) refuse("must be a whole number");
  return static_cast<int>(value);
}

std::string JsonInput::text() const {
  if (!value_->is_string()) refuse("must be a text \"...\"");
  return value_->get<std::string>();
}

std::vector<double> JsonInput::numbers(std::size_t count) const {
  if (size() != count) refuse(fmt::format("has {} entries; must have {}", size(), count));
  std::vector<double> values(count);
  if (const std::size_t wrong = read_numbers(*value_, values); wrong < count)
    element(wrong).refuse("must be a finite number");
  return values;
}

void JsonInput::numbers_of(std::size_t i, std::span<double> values) const {
  const json& row = (*value_)[i];
  if (!row.is_array() || row.size() != values.size() || read_numbers(row, values) < values.size())
    static_cast<void>(element(i).numbers(values.size()));  // it says what is wrong
}

std::vector<Vec2> JsonInput::pairs() const {
  std::vector<Vec2> points(size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::vector<double> pair = element(i).numbers(2);
    points[i] = {pair[0], pair[1]};
  }
  return points;
}

std::string exact_number(double value) {
  if (!std::isfinite(value)) throw InternalError("a number to be written to a file is not finite");
  // The fewest digits that read back as the same bits.
  return fmt::format("{}", value);
}

std::string exact_decimal(double value) {
  // Readers of DXF and APT do not all take exponents.
  std::string text = exact_number(std::abs(value) < kSmallestDecimal ? 0.0 : value);
  if (const std::size_t e = text.find('e'); e != std::string::npos) {
    // The same digits, with zeros in place of the exponent.
    const int exponent = std::stoi(text.substr(e + 1));
    const std::string sign = value < 0.0 ? "-" : "";
    std::string digits = text.substr(sign.size(), e - sign.size());
    std::erase(digits, '.');
    const auto places = static_cast<std::size_t>(std::abs(exponent));
    if (exponent < 0)
      text = sign + "0." + std::string(places - 1, '0') + digits;
    else if (digits.size() > places + 1)
      text = sign + digits.substr(0, places + 1) + "." + digits.substr(places + 1);
    else
      text = sign + digits + std::string(places + 1 - digits.size(), '0');
  }
  return text.find('.') == std::string::npos ? text + ".0" : text;
}

std::string json_string(std::string_view text) {
  // As ASCII with escapes, so that no reader has to guess an encoding.
  return json(text).dump(-1, ' ', true, json::error_handler_t::replace);
}

}  // namespace flank::internal
