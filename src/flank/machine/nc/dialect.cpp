#include "flank/machine/nc/dialect.h"

#include <array>

#include "flank/error.h"
#include "flank/machine/nc/nc_number.h"

namespace flank::internal {

namespace {

/// In the order of NcLanguage.
constexpr std::array<std::string_view, 5> kNames = {"linuxcnc", "fanuc", "siemens", "heidenhain", "apt"};

constexpr int kInverseTimeDigits = 8, kFeedDigits = 4;  // significant ones

}  // namespace

int nc_feed_decimals(NcFeedMode mode, double feed, const NcDialect& dialect) {
  // 1/min runs over many powers of ten, so digits count instead of decimals. mm/min have the dialect's decimals, and
  // more only where a slow feed would be rounded by more than its fourth digit.
  return mode == NcFeedMode::kInverseTime ? decimals_of(feed, 1, kInverseTimeDigits)
                                          : decimals_of(feed, dialect.feed_decimals, kFeedDigits);
}

std::string_view nc_language_name(NcLanguage language) { return kNames.at(static_cast<std::size_t>(language)); }

NcLanguage nc_language(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (name == kNames[i]) return static_cast<NcLanguage>(i);
  throw UsageError("dialect", "\"" + std::string(name) + "\"",
                   "accepted are linuxcnc, fanuc, siemens, heidenhain and apt");
}

}  // namespace flank::internal
