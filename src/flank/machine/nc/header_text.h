/// What our programs say in comments, the same in every dialect: part, tool, strips.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flank/machine/nc/program.h"

namespace flank::internal {

/// Longest comment; the narrowest of the controls reads lines of 255 characters.
inline constexpr std::size_t kLongestNcComment = 200;

/// A name without the characters that end a comment, continue a line or begin something else in any of the dialects:
/// what is not printable ASCII, and ( ) ; % ~ $ " each become "_". No longer than kLongestNcComment.
[[nodiscard]] std::string safe_comment(std::string_view name);

/// What the header of a program without a spindle says, and how a line begins that says why a program is not what was asked.
inline constexpr std::string_view kStandsStill = "DRY RUN: THE SPINDLE STANDS STILL";
inline constexpr std::string_view kFallsShort = "DOES NOT MEET ITS REQUEST: ";
inline constexpr std::string_view kCaution = "CAUTION: ";

/// The comments of the header: part, machine, set-up, tool.
[[nodiscard]] std::vector<std::string> header_comments(const NcHeader& header);
/// In a comment of a program that is to be run without the spindle.
inline constexpr std::string_view kDryRun = "DRY RUN";
/// Takes what one such comment says; false if it says nothing of a header. What an earlier one has said stays, and that they
/// differ is kept.
bool read_header_comment(std::string_view comment, NcHeader& header);

/// Operations of a program, at most.
inline constexpr int kMostOperations = 9'999;
/// "OPERATION 2 OF 6 finish", or "OPERATION 2 OF 6 COPY 2 OF 3 finish": what begins an operation of a program of several.
[[nodiscard]] std::string operation_comment(const NcOperation& operation);
/// The operation that such a comment begins; nothing if it is another comment.
[[nodiscard]] std::optional<NcOperation> read_operation_comment(std::string_view comment);

/// "STRIP 3 flank F1,F3", and the comment after which moves belong to no strip.
[[nodiscard]] std::string strip_comment(const NcStrip& strip);
inline constexpr std::string_view kEndOfStrip = "END OF STRIP";
/// The strip that such a comment begins; nothing if it is another comment.
[[nodiscard]] std::optional<NcStrip> read_strip_comment(std::string_view comment);

}  // namespace flank::internal
