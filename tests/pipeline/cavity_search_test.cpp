// How long the search for a cavity's tool goes on with thinner ones.
#include "flank/pipeline/search/cavity_search.h"

#include <gtest/gtest.h>

namespace flank::internal {
namespace {

TEST(CavitySearch, EndsAtOnceWhereCyclesGetThroughAndAThinnerToolGainsNothing) {
  SearchPatience patience;
  EXPECT_FALSE(patience.ends_after(true, true));
  EXPECT_TRUE(patience.ends_after(false, true));
}

TEST(CavitySearch, EndsAfterTwoToolsInARowThatGetNoFartherWhereCyclesGetStuck) {
  SearchPatience patience;
  EXPECT_FALSE(patience.ends_after(true, false));
  EXPECT_FALSE(patience.ends_after(false, false)) << "one tool may be unlucky";
  EXPECT_FALSE(patience.ends_after(true, false));
  EXPECT_FALSE(patience.ends_after(false, false)) << "what gains begins anew";
  EXPECT_TRUE(patience.ends_after(false, false));
}

}  // namespace
}  // namespace flank::internal
