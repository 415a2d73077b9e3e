#include "flank/machine/nc/nc_number.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "flank/base/assert.h"
#include "flank/error.h"

namespace flank::internal {

namespace {

/// Powers of ten by the number of decimals.
constexpr std::array<std::int64_t, kMostNcDecimals + 1> kScale = {1,      10,      100,      1000,      10000,
                                                                  100000, 1000000, 10000000, 100000000, 1000000000};

/// Integers print faster than doubles, and 1e6 with nine decimals is one that a double holds.
void append(std::string& text, double value, int decimals, NcNumberStyle style, bool always_point) {
  FLANK_ASSERT(decimals >= 0 && decimals <= kMostNcDecimals);
  if (!std::isfinite(value)) throw InternalError("a program has a number that is not finite");
  if (std::abs(value) > kLargestNcValue)
    throw UsageError("a program would state " + std::to_string(value) + "; expected values up to 1000000");
  const std::int64_t scale = kScale[static_cast<std::size_t>(decimals)];
  // Rounded once, then taken apart exactly. A sign is written only if something is left of the value: never "-0".
  const std::int64_t scaled = std::llround(value * static_cast<double>(scale));
  const std::int64_t size = scaled < 0 ? -scaled : scaled;
  std::array<char, 32> buffer{};
  if (scaled < 0)
    text += '-';
  else if (style.plus)
    text += '+';
  const auto whole = std::to_chars(buffer.data(), buffer.data() + buffer.size(), size / scale);
  text.append(buffer.data(), whole.ptr);
  std::int64_t rest = size % scale;
  if (rest == 0) {
    if (always_point) (text += style.point) += '0';
    return;
  }
  int count = decimals;
  // Zeros at the end say nothing, and would double the size of a program.
  for (; rest % 10 == 0; rest /= 10) --count;
  text += style.point;
  for (int i = count - 1; i >= 0; --i, rest /= 10)
    buffer[static_cast<std::size_t>(i)] = static_cast<char>('0' + rest % 10);
  text.append(buffer.data(), static_cast<std::size_t>(count));
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

void append_decimal(std::string& text, double value, int decimals, NcNumberStyle style) {
  append(text, value, decimals, style, true);
}

void append_short_decimal(std::string& text, double value, int decimals, NcNumberStyle style) {
  append(text, value, decimals, style, false);
}

int decimals_of(double value, int least, int significant) {
  // The power of ten of the first significant digit.
  const int first = value > 0.0 ? static_cast<int>(std::floor(std::log10(value))) : 0;
  return std::clamp(std::max(least, significant - 1 - first), 0, kMostNcDecimals);
}

std::optional<NcNumber> leading_number(std::string_view text, bool comma) {
  constexpr std::size_t kLongest = 40;  // digits beyond it say nothing more
  std::array<char, kLongest> plain{};
  NcNumber number;
  std::size_t i = 0, used = 0, digits = 0;
  if (i < text.size() && (text[i] == '+' || text[i] == '-')) {
    if (text[i] == '-') plain[used++] = '-';
    ++i;
  }
  for (; i < text.size() && used < kLongest; ++i) {
    const char c = text[i];
    const bool point = c == '.' || (comma && c == ',');
    if (point && number.point) break;  // "1.2.3": the rest belongs to the next word
    if (!point && !is_digit(c)) break;
    number.point = number.point || point;
    digits += point ? 0 : 1;
    plain[used++] = point ? '.' : c;
  }
  // A sign or a point alone is no number; one that fills the buffer is damage, and what is behind it unknown.
  if (digits == 0 || used == kLongest) return std::nullopt;
  const auto [end, error] = std::from_chars(plain.data(), plain.data() + used, number.value, std::chars_format::fixed);
  if (error != std::errc() || std::abs(number.value) > kLargestNcNumber) return std::nullopt;
  if (number.value == 0.0) number.value = 0.0;  // "-0.0"
  number.length = i;
  return number;
}

}  // namespace flank::internal
