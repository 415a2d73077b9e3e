#include "flank/correct/run_correct.h"

#include <gtest/gtest.h>

namespace flank::internal {
namespace {

/// A job may leave out a whole solid; the mirrored part has its faces, but no solids.
TEST(FacesNotChecked, AreNamedOneByOne) {
  internal::Setup setup;
  setup.part.faces.resize(5);
  setup.targets = {0};
  setup.checks = {2};
  EXPECT_EQ(faces_not_checked(setup), "F2,F4,F5");
  setup.checks = {1, 2, 3, 4};
  EXPECT_FALSE(faces_not_checked(setup));
}

}  // namespace
}  // namespace flank::internal
