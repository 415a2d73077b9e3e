#include "flank/io/text/toml_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

// What toml++ asserts in debug builds it takes for granted in release builds, and damaged files do get there: in both they
// are refused.
namespace flank::internal {
struct UnexpectedToml {};
[[noreturn]] static void refuse_toml() { throw UnexpectedToml(); }
}  // namespace flank::internal
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(condition) ((condition) ? static_cast<void>(0) : flank::internal::refuse_toml())
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

#include "flank/error.h"

namespace flank::internal {
namespace {

/// "file: line 7, column 3", the beginning of every message.
std::string place(const std::string& file, const toml::source_position& at) {
  return fmt::format("{}: line {}, column {}", file, at.line, at.column);
}

std::string range_text(NumberRange range) { return fmt::format("a number from {:g} to {:g}", range.low, range.high); }

/// A plain value as a word; none for a list, a table or a date.
std::optional<std::string> word_of(const toml::node& node) {
  if (node.is_string()) return node.value<std::string>();
  if (node.is_boolean()) return *node.value<bool>() ? "on" : "off";
  if (node.is_integer()) return std::to_string(*node.value<std::int64_t>());
  if (node.is_floating_point()) return fmt::format("{}", *node.value<double>());
  return {};
}

/// Where a character beyond ASCII first stands outside of texts and comments, where TOML allows none; npos if nowhere. toml++
/// takes for granted that its tables hold every such character, and they do not.
std::size_t stray_character(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";  // some editors put it first
  std::size_t at = text.starts_with(kMark) ? kMark.size() : 0;
  while (at < text.size()) {
    const char c = text[at];
    if (static_cast<unsigned char>(c) >= 0x80) return at;
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
    } else if (c == '"' || c == '\'') {
      // Three of them hold several lines; one that is not closed on its line is refused by toml++ there.
      const std::string three(3, c);
      const bool lines = text.substr(at, 3) == three;
      const std::string_view end = std::string_view(three).substr(0, lines ? 3 : 1);
      at += end.size();
      while (at < text.size() && text.substr(at, end.size()) != end && (lines || text[at] != '\n'))
        at += c == '"' && text[at] == '\\' ? 2 : 1;
      // A text of several lines may end with quotes of its own, which stand before the three.
      if (at < text.size()) at += end.size();
      while (lines && at < text.size() && text[at] == c) ++at;
    } else {
      ++at;
    }
  }
  return std::string_view::npos;
}

void require_plain(std::string_view text, const std::string& file) {
  const std::size_t at = stray_character(text);
  if (at == std::string_view::npos) return;
  const std::string_view before = text.substr(0, at);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  throw InputError(fmt::format("{}: line {}, column {}: a character that is not ASCII stands outside of quotes", file,
                               line, at - (before.rfind('\n') + 1) + 1));
}

bool inside(double x, NumberRange range) { return std::isfinite(x) && x >= range.low && x <= range.high; }

}  // namespace

struct TomlTable::Data {
  // Tables of one document share it: a table stays valid after the one that it was taken from is gone.
  std::shared_ptr<const toml::table> document;  ///< keeps `values` alive
  const toml::table* values = nullptr;          ///< null: a table that is missing
  std::string file;
  // Reading notes the key, also where it is missing: the list of what may stand here comes from the readers
  // themselves, and cannot lag behind them.
  mutable std::set<std::string> asked;

  const toml::node* find(const std::string& key) const {
    asked.insert(key);
    return values != nullptr ? values->get(key) : nullptr;
  }
};

TomlTable TomlTable::parse(std::string_view text, const std::string& file) {
  auto data = std::make_shared<Data>();
  data->file = file;
  require_plain(text, file);
  try {
    data->document = std::make_shared<const toml::table>(toml::parse(text, file));
  } catch (const toml::parse_error& e) {
    throw InputError(place(file, e.source().begin) + ": " + std::string(e.description()));
  } catch (const UnexpectedToml&) {
    throw InputError(file + ": is not TOML: a key or a value stands where none may be");
  }
  data->values = data->document.get();
  TomlTable table;
  table.data_ = std::move(data);
  return table;
}

void TomlTable::refuse(const std::string& key, const std::string& text) const {
  const toml::node* node = data_->find(key);
  // A table that is missing has no place; the file's name is all there is.
  if (node == nullptr && data_->values == nullptr) throw InputError(fmt::format("{}: {}: {}", data_->file, key, text));
  const toml::source_region& where = node != nullptr ? node->source() : data_->values->source();
  throw InputError(fmt::format("{}: {}: {}", place(data_->file, where.begin), key, text));
}

bool TomlTable::has(const std::string& key) const { return data_->find(key) != nullptr; }

double TomlTable::number(const std::string& key, NumberRange range) const {
  const toml::node* node = data_->find(key);
  if (node == nullptr) refuse(key, "is missing; " + range_text(range) + " is needed");
  // Not `1`, where a whole number stands for itself, but `true` and "1" are none.
  const std::optional<double> value = node->is_number() ? node->value<double>() : std::nullopt;
  if (!value || !inside(*value, range)) refuse(key, range_text(range) + " is needed");
  return *value;
}

int TomlTable::whole(const std::string& key, int low, int high) const {
  const toml::node* node = data_->find(key);
  const std::optional<std::int64_t> value =
      node != nullptr && node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
  if (!value || *value < low || *value > high)
    refuse(key, fmt::format("a whole number from {} to {} is needed", low, high));
  return static_cast<int>(*value);
}

bool TomlTable::flag(const std::string& key) const {
  const toml::node* node = data_->find(key);
  if (node == nullptr || !node->is_boolean()) refuse(key, "true or false is needed");
  return *node->value<bool>();
}

std::string TomlTable::text(const std::string& key) const {
  const toml::node* node = data_->find(key);
  if (node == nullptr || !node->is_string()) refuse(key, "a text in quotes is needed");
  return *node->value<std::string>();
}

std::string TomlTable::word(const std::string& key, const std::vector<std::string>& accepted) const {
  const toml::node* node = data_->find(key);
  const std::optional<std::string> value =
      node != nullptr && node->is_string() ? node->value<std::string>() : std::nullopt;
  if (value)
    for (const std::string& word : accepted)
      if (*value == word) return word;
  refuse(key, fmt::format("accepted are \"{}\"", fmt::join(accepted, "\", \"")));
}

std::vector<double> TomlTable::numbers(const std::string& key, std::size_t count, NumberRange range) const {
  const std::string needed = fmt::format("[{} numbers from {:g} to {:g}] are needed", count, range.low, range.high);
  const toml::node* node = data_->find(key);
  const toml::array* array = node != nullptr ? node->as_array() : nullptr;
  if (array == nullptr || array->size() != count) refuse(key, needed);
  std::vector<double> values;
  for (const toml::node& element : *array) {
    const std::optional<double> value = element.is_number() ? element.value<double>() : std::nullopt;
    if (!value || !inside(*value, range))
      throw InputError(fmt::format("{}: {}: {}", place(data_->file, element.source().begin), key, needed));
    values.push_back(*value);
  }
  return values;
}

std::vector<std::string> TomlTable::texts(const std::string& key) const {
  const toml::node* node = data_->find(key);
  const toml::array* array = node != nullptr ? node->as_array() : nullptr;
  if (array == nullptr || array->empty()) refuse(key, "a list of texts in quotes, [\"...\"], is needed");
  std::vector<std::string> all;
  for (const toml::node& element : *array) {
    if (!element.is_string()) refuse_element(key, all.size(), "a text in quotes is needed");
    all.push_back(*element.value<std::string>());
  }
  return all;
}

std::vector<std::string> TomlTable::words(const std::string& key) const {
  const toml::node* node = data_->find(key);
  if (node == nullptr) refuse(key, "is missing; a value is needed");
  std::vector<std::string> all;
  if (const toml::array* array = node->as_array()) {
    for (const toml::node& element : *array) {
      const std::optional<std::string> word = word_of(element);
      if (!word) refuse_element(key, all.size(), "a text, a number, true or false is needed");
      all.push_back(*word);
    }
    return all;
  }
  const std::optional<std::string> word = word_of(*node);
  if (!word) refuse(key, "a text, a number, true or false, or a list of them is needed");
  return {*word};
}

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::string> all;
  if (data_->values == nullptr) return all;
  for (const auto& [key, value] : *data_->values) all.emplace_back(key.str());
  data_->asked.insert(all.begin(), all.end());
  return all;
}

void TomlTable::refuse_element(const std::string& key, std::size_t element, const std::string& text) const {
  const toml::node* node = data_->find(key);
  const toml::array* array = node != nullptr ? node->as_array() : nullptr;
  if (array == nullptr || element >= array->size()) refuse(key, text);
  throw InputError(fmt::format("{}: {}: {}", place(data_->file, (*array)[element].source().begin), key, text));
}

Vec3 TomlTable::vector(const std::string& key, NumberRange range) const {
  const std::vector<double> values = numbers(key, 3, range);
  return {values[0], values[1], values[2]};
}

TomlTable TomlTable::table(const std::string& key) const {
  const toml::node* node = data_->find(key);
  if (node != nullptr && !node->is_table()) refuse(key, "a table [" + key + "] is needed");
  // Its own list of keys that were asked for: the same table taken a second time begins a new one.
  auto data = std::make_shared<Data>();
  data->document = data_->document;
  data->values = node != nullptr ? node->as_table() : nullptr;
  data->file = data_->file;
  TomlTable table;
  table.data_ = std::move(data);
  return table;
}

std::vector<TomlTable> TomlTable::tables(const std::string& key) const {
  const toml::node* node = data_->find(key);
  if (node == nullptr) return {};
  const std::string needed = "tables [[" + key + "]] are needed";
  const toml::array* array = node->as_array();
  if (array == nullptr) refuse(key, needed);
  std::vector<TomlTable> list;
  for (const toml::node& element : *array) {
    if (!element.is_table()) refuse(key, needed);
    auto data = std::make_shared<Data>();
    data->document = data_->document;
    data->values = element.as_table();
    data->file = data_->file;
    TomlTable table;
    table.data_ = std::move(data);
    list.push_back(std::move(table));
  }
  return list;
}

void TomlTable::require_all_known() const {
  if (data_->values == nullptr) return;
  const std::set<std::string> known = data_->asked;
  for (const auto& [key, value] : *data_->values) {
    const std::string name(key.str());
    if (known.contains(name)) continue;
    throw InputError(fmt::format("{}: {}: is no key here; there are {}", place(data_->file, key.source().begin), name,
                                 fmt::join(known, ", ")));
  }
}

}  // namespace flank::internal
