/// Strict reading of our own JSON files: every complaint names the file and the key.
#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "flank/vec.h"

namespace flank::internal {

/// The whole file as bytes. Throws InputError if it is missing, a folder, unreadable, empty, or above 512 MB.
[[nodiscard]] std::string read_file(const std::string& file);

/// A value of a document and where it stands, e.g. "tool.json: samples[3]". Every accessor throws InputError with that
/// place.
class JsonInput {
 public:
  /// Parses `text`. Refuses what is not JSON (with line and column), a key that occurs twice in one object, and numbers
  /// out of range.
  JsonInput(const std::string& file, std::string_view text);
  /// The same of a document most of which is an array of objects at its top, under the key `list`: each of them is handed to `each` as soon as
  /// it is read, in order, and is not kept, so that the array stays empty; as a whole a long path takes ten times the memory of its numbers.
  JsonInput(const std::string& file, std::string_view text, const std::string& list,
            const std::function<void(const JsonInput&)>& each);

  /// Requires "schema" to be `schema` and "units", where there is one, to be "mm".
  void require_schema(std::string_view schema) const;
  /// Refuses keys of this object that are not in `known`, naming those.
  void allow_keys(std::initializer_list<std::string_view> known) const;

  [[nodiscard]] bool has(std::string_view key) const;
  [[nodiscard]] JsonInput member(std::string_view key) const;
  [[nodiscard]] std::size_t size() const;  ///< of an array
  [[nodiscard]] JsonInput element(std::size_t i) const;
  [[nodiscard]] std::vector<std::string> keys() const;  ///< of an object, in alphabetical order

  [[nodiscard]] bool is_array() const;
  [[nodiscard]] double number() const;    ///< finite
  [[nodiscard]] double positive() const;  ///< finite and > 0
  [[nodiscard]] int integer() const;
  [[nodiscard]] std::string text() const;
  /// An array of exactly `count` finite numbers.
  [[nodiscard]] std::vector<double> numbers(std::size_t count) const;
  /// The same of element `i` of this array, into `values`, which is as long as it must be.
  void numbers_of(std::size_t i, std::span<double> values) const;
  /// An array of pairs of finite numbers.
  [[nodiscard]] std::vector<Vec2> pairs() const;

  [[noreturn]] void refuse(const std::string& why) const;

 private:
  JsonInput(std::shared_ptr<const nlohmann::json> document, const nlohmann::json& value, std::string file,
            std::string place)
      : document_(std::move(document)), value_(&value), file_(std::move(file)), place_(std::move(place)) {}

  std::shared_ptr<const nlohmann::json> document_;
  const nlohmann::json* value_ = nullptr;
  std::string file_, place_;
};

/// A number with the fewest digits that read back as the same double (at most 17 significant ones). Throws
/// InternalError if it is not finite.
[[nodiscard]] std::string exact_number(double value);
/// The same without an exponent, for formats that have none; always with a decimal point. Less than kSmallestDecimal is
/// written as 0.
inline constexpr double kSmallestDecimal = 1e-30;
[[nodiscard]] std::string exact_decimal(double value);
/// A JSON string with its quotes.
[[nodiscard]] std::string json_string(std::string_view text);

}  // namespace flank::internal
