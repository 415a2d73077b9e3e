/// Blocks of Siemens programs, taken apart.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "flank/machine/nc/read/nc_lines.h"

namespace flank::internal {

/// One word: "X12.5" and "X=12.5" (name X, a value), "A3=0.5" (name A3), "G1" (name G), "T=\"BARREL\"" (a string),
/// "CYCLE832(0.01,1,1)" (arguments), "TRAORI" (a name alone). Names are in upper case.
struct SiemensWord {
  std::string_view name;
  std::optional<double> value;
  std::optional<std::string_view> string;     ///< without its quotes, as it stands
  std::optional<std::string_view> arguments;  ///< between the parentheses
  std::string_view text;                      ///< the whole word as it stands
};

struct SiemensBlock {
  std::vector<SiemensWord> words;
  std::string_view comment;  ///< behind the semicolon
  bool skipped = false;      ///< it begins with /: the control leaves it out where its operator says so
};

/// Takes the line apart (`upper` is the same in upper case); views point into both. Refuses what is no word: parameters,
/// expressions, labels.
void split_siemens(std::string_view line, std::string_view upper, const NcPlace& place, SiemensBlock& block);

}  // namespace flank::internal
