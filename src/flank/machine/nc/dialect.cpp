#include "flank/machine/nc/dialect.h"

#include "flank/machine/nc/nc_number.h"

namespace flank::internal {

namespace {

constexpr int kInverseTimeDigits = 8, kFeedDigits = 4;  // significant ones

}  // namespace

int nc_feed_decimals(NcFeedMode mode, double feed, const NcDialect& dialect) {
  // 1/min runs over many powers of ten, so digits count instead of decimals. mm/min have the dialect's decimals, and
  // more only where a slow feed would be rounded by more than its fourth digit.
  return mode == NcFeedMode::kInverseTime ? decimals_of(feed, 1, kInverseTimeDigits)
                                          : decimals_of(feed, dialect.feed_decimals, kFeedDigits);
}

}  // namespace flank::internal
