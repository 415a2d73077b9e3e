// Commands end with 1 for every figure of the verdict that is false, and with 0 for what is only to be minded.
#include <gtest/gtest.h>

#include "commands.h"
#include "flank/results/acceptance.h"

namespace flank::cli {
namespace {

using namespace internal;

TEST(ExitCode, EveryFigureThatIsFalseIsOne) {
  EXPECT_EQ(exit_code({}), kMeetsRequest);
  for (std::size_t k = 0; k < kFigureNames.size(); ++k) {
    Acceptance no, amber;
    add_reason(no, static_cast<Figure>(k), "why");
    EXPECT_EQ(exit_code(no), kFallsShort) << kFigureNames[k];
    add_caution(amber, static_cast<Figure>(k), "mind");
    EXPECT_EQ(exit_code(amber), kMeetsRequest) << kFigureNames[k];
  }
}

}  // namespace
}  // namespace flank::cli
