/// Numbers as programs have them: decimals without an exponent.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace flank::internal {

/// Largest value that a program may state (mm, degrees, mm/min, 1/min): far beyond any machine, and with nine decimals
/// still exact as a double's integer.
inline constexpr double kLargestNcValue = 1e6;
/// Largest number that is read at all, be it of a block or of a label.
inline constexpr double kLargestNcNumber = 1e9;
inline constexpr int kMostNcDecimals = 9;

/// How a dialect looks at numbers.
struct NcNumberStyle {
  char point = '.';
  bool plus = false;  ///< a sign on every number
};

/// Appends the value rounded to that many decimals (0 to kMostNcDecimals), with at least one decimal, without further
/// zeros: "12.5", "70.0", "-0.25"; never "-0.0". Throws InternalError if it is not finite, UsageError beyond
/// kLargestNcValue.
void append_decimal(std::string& text, double value, int decimals, NcNumberStyle style = {});
/// The same without a point where the rounded value is whole: "1000".
void append_short_decimal(std::string& text, double value, int decimals, NcNumberStyle style = {});

/// Decimals with which a value > 0 keeps at least that many significant digits, and at least `least`.
[[nodiscard]] int decimals_of(double value, int least, int significant);

/// The number at the beginning of the text: an optional sign, digits and one point (or comma, where `comma`), at least
/// one digit. Nothing if there is none, or if it is beyond kLargestNcNumber.
struct NcNumber {
  double value = 0.0;
  std::size_t length = 0;  ///< characters of the text that it takes
  bool point = false;      ///< whether it has a point
};
[[nodiscard]] std::optional<NcNumber> leading_number(std::string_view text, bool comma = false);

}  // namespace flank::internal
