/// TOML values read with their place, which every message about such a file says.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flank/vec.h"

namespace flank::internal {

/// A number as a user may write it, with what would be accepted.
struct NumberRange {
  double low = -1e9, high = 1e9;
};

/// A table of a TOML text. Keys are taken out of it one by one; what is left in the end is unknown. The values are owned by
/// the document, so tables are cheap to copy.
class TomlTable {
 public:
  /// The whole text. Throws InputError with file, line and column.
  static TomlTable parse(std::string_view text, const std::string& file);

  [[nodiscard]] bool has(const std::string& key) const;
  /// Each throws InputError where the key is missing, of another type, or not accepted.
  [[nodiscard]] double number(const std::string& key, NumberRange range) const;
  [[nodiscard]] int whole(const std::string& key, int low, int high) const;
  [[nodiscard]] bool flag(const std::string& key) const;
  [[nodiscard]] std::string text(const std::string& key) const;
  /// One of `accepted`.
  [[nodiscard]] std::string word(const std::string& key, const std::vector<std::string>& accepted) const;
  [[nodiscard]] std::vector<double> numbers(const std::string& key, std::size_t count, NumberRange range) const;
  [[nodiscard]] Vec3 vector(const std::string& key, NumberRange range = {}) const;
  /// A list of texts, at least one.
  [[nodiscard]] std::vector<std::string> texts(const std::string& key) const;
  /// A value, or a list of values, as the words of a command line: texts as they are, numbers with all their digits, on or
  /// off.
  [[nodiscard]] std::vector<std::string> words(const std::string& key) const;
  /// All keys, in alphabetical order; all of them count as known.
  [[nodiscard]] std::vector<std::string> keys() const;
  /// [key]; an empty one where it is missing.
  [[nodiscard]] TomlTable table(const std::string& key) const;
  /// [[key]], empty where it is missing.
  [[nodiscard]] std::vector<TomlTable> tables(const std::string& key) const;

  /// Throws InputError for a key that nobody has asked for.
  void require_all_known() const;
  /// Throws InputError at the key, or at the table where it is not there.
  [[noreturn]] void refuse(const std::string& key, const std::string& text) const;
  /// The same at an element of a list.
  [[noreturn]] void refuse_element(const std::string& key, std::size_t element, const std::string& text) const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

}  // namespace flank::internal
