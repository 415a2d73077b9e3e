/// The units of length that files and the command line know.
#pragma once

#include <string>

namespace flank::internal {

/// Millimetres in one mm, cm, m or in. Throws UsageError for another name.
[[nodiscard]] double millimetres_per(const std::string& unit);

/// The short name (mm, cm, m, in, ft, ...) of a unit of that many millimetres; "<n> mm" where it has none.
[[nodiscard]] std::string unit_of(double millimetres);

}  // namespace flank::internal
