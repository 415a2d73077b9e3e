#include "flank/io/text/read_text.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "flank/error.h"

namespace flank::internal {
namespace {

constexpr std::string_view kSpace = " \t\r\v\f";

}  // namespace

// Words are views into the content: nothing is copied, which makes large meshes quick to read.
bool TextLines::next() {
  while (at_ < content_.size()) {
    const std::size_t end = std::min(content_.find('\n', at_), content_.size());
    const std::string_view text = content_.substr(at_, end - at_);
    at_ = std::min(end + 1, content_.size());
    ++line_;
    words_.clear();
    for (std::size_t i = text.find_first_not_of(kSpace); i != std::string_view::npos;) {
      const std::size_t stop = std::min(text.find_first_of(kSpace, i), text.size());
      words_.push_back(text.substr(i, stop - i));
      i = text.find_first_not_of(kSpace, stop);
    }
    if (!words_.empty()) return true;
  }
  words_.clear();
  return false;
}

double TextLines::number(std::size_t i) const {
  std::string_view text = word(i);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error == std::errc::invalid_argument || end != text.data() + text.size())
    refuse(fmt::format("\"{}\" is not a number", word(i)));
  if (error == std::errc::result_out_of_range || !std::isfinite(value))
    refuse(fmt::format("\"{}\" is not a finite number; expected finite coordinates", word(i)));
  return value;
}

long TextLines::integer(std::size_t i) const {
  std::string_view text = word(i);
  // "7/3/1" of an OBJ face: vertex, texture, normal.
  text = text.substr(0, text.find('/'));
  long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size())
    refuse(fmt::format("\"{}\" is not a whole number", word(i)));
  return value;
}

void TextLines::refuse(const std::string& why) const {
  throw InputError(fmt::format("{}, line {}: {}", file_, line_, why));
}

}  // namespace flank::internal
