/// What is to be written into files.
#pragma once

#include <concepts>
#include <functional>
#include <map>
#include <string>
#include <utility>

namespace flank::internal {

/// A text, or what makes it at the moment that it is written: the files of a long path are several times as large as the path, and are never in
/// memory together.
class FileText {
 public:
  FileText() = default;
  FileText(const char* text) : text_(text) {}             // NOLINT(google-explicit-constructor)
  FileText(std::string text) : text_(std::move(text)) {}  // NOLINT(google-explicit-constructor)
  template <std::invocable Make>
  FileText(Make make) : make_(std::move(make)) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] std::string text() const { return make_ ? make_() : text_; }

 private:
  std::string text_;
  std::function<std::string()> make_;
};

using FileTexts = std::map<std::string, FileText>;  ///< by name

}  // namespace flank::internal
