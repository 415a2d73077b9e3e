#include "flank/error.h"

#include <gtest/gtest.h>

namespace flank::internal {
namespace {

TEST(Error, EveryKindKeepsItsMessageAndIsAnError) {
  for (const auto& raise : {+[] { throw UsageError("what went wrong"); }, +[] { throw InputError("what went wrong"); },
                            +[] { throw InternalError("what went wrong"); }}) {
    try {
      raise();
      FAIL() << "nothing was thrown";
    } catch (const Error& caught) {
      EXPECT_STREQ(caught.what(), "what went wrong");
      EXPECT_EQ(caught.field(), "");
    }
  }
}

TEST(Error, AMessageAboutAFieldBeginsWithItsName) {
  const UsageError plain("tolerance_mm", "expected a length > 0 mm");
  EXPECT_STREQ(plain.what(), "tolerance_mm: expected a length > 0 mm");
  EXPECT_EQ(plain.field(), "tolerance_mm");
  const InputError with_value("catalogue", "/nowhere", "no such folder");
  EXPECT_STREQ(with_value.what(), "catalogue /nowhere: no such folder");
  EXPECT_EQ(with_value.field(), "catalogue");
}

}  // namespace
}  // namespace flank::internal
