#include "flank/error.h"

#include <gtest/gtest.h>

namespace flank::internal {
namespace {

template <class E>
int exit_code_of(const E& error) {
  try {
    throw error;
  } catch (const Error& caught) {
    EXPECT_STREQ(caught.what(), "what went wrong");
    return caught.exit_code();
  }
}

TEST(Error, EveryKindHasItsExitCodeAndKeepsItsMessage) {
  EXPECT_EQ(exit_code_of(UsageError("what went wrong")), 2);
  EXPECT_EQ(exit_code_of(InputError("what went wrong")), 3);
  EXPECT_EQ(exit_code_of(InternalError("what went wrong")), 4);
}

}  // namespace
}  // namespace flank::internal
