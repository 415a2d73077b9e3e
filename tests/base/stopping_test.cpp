#include "flank/base/stopping.h"

#include <gtest/gtest.h>

namespace flank::internal {
namespace {

TEST(Stopping, WorkIsStoppedOnceThatIsAsked) {
  EXPECT_FALSE(stopping());
  EXPECT_NO_THROW(stop_here());
  {
    const StopForTest stop;
    EXPECT_TRUE(stopping());
    EXPECT_THROW(stop_here(), Stopped);
  }
  EXPECT_FALSE(stopping());
}

TEST(Stopping, IsPutOffForALittleWhile) {
  const StopForTest stop;
  {
    const StopGrace grace(1e6);
    EXPECT_FALSE(stopping());
    EXPECT_NO_THROW(stop_here());
  }
  EXPECT_TRUE(stopping());
  const StopGrace over(-1.0);
  EXPECT_TRUE(stopping());
}

}  // namespace
}  // namespace flank::internal
