/// A field's value as a word of a command line, and back. What is written reads back as the same value.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "flank/job/fields.h"

namespace flank::internal {

/// Name of a field in messages: the key with its unit, "tolerance_mm", as the member is called in most jobs.
[[nodiscard]] std::string field_name(const FieldInfo& info);

/// Its option on a command line, "--axis-length", or for a word without option its name there, "PART".
[[nodiscard]] std::string flag_of(const FieldInfo& info);

/// The words that give a value; none for an optional that is not set.
[[nodiscard]] std::vector<std::string> field_words(const FieldInfo& info, const std::string& value);
[[nodiscard]] std::vector<std::string> field_words(const FieldInfo& info, double value);
[[nodiscard]] std::vector<std::string> field_words(const FieldInfo& info, int value);
[[nodiscard]] std::vector<std::string> field_words(const FieldInfo& info, std::uint64_t value);
[[nodiscard]] std::vector<std::string> field_words(const FieldInfo& info, bool value);
[[nodiscard]] std::vector<std::string> field_words(const FieldInfo& info, const std::vector<std::string>& value);
template <class T>
[[nodiscard]] std::vector<std::string> field_words(const FieldInfo& info, const std::optional<T>& value) {
  return value ? field_words(info, *value) : std::vector<std::string>();
}

/// Reads a word into a value; a list grows by it. Throws UsageError for a word that is no such value. Ranges are not
/// checked here (check_fields.h).
void read_word(const FieldInfo& info, const std::string& word, std::string& value);
void read_word(const FieldInfo& info, const std::string& word, double& value);
void read_word(const FieldInfo& info, const std::string& word, int& value);
void read_word(const FieldInfo& info, const std::string& word, std::uint64_t& value);
void read_word(const FieldInfo& info, const std::string& word, bool& value);
void read_word(const FieldInfo& info, const std::string& word, std::vector<std::string>& value);
template <class T>
void read_word(const FieldInfo& info, const std::string& word, std::optional<T>& value) {
  T read{};
  read_word(info, word, read);
  value = std::move(read);
}

}  // namespace flank::internal
