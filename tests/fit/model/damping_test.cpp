// How the fate of a step changes the damping of the next.
#include "flank/fit/model/damping.h"

#include <gtest/gtest.h>

namespace flank::internal {
namespace {

TEST(Damping, GrowsFasterWithEveryRefusalInARow) {
  Damping damping;
  double before = damping.value(), growth = 1.0;
  damping.refuse();  // to where a step changes at all
  before = damping.value();
  for (int k = 0; k < 4; ++k) {
    damping.refuse();
    EXPECT_GT(damping.value() / before, growth);
    growth = damping.value() / before;
    before = damping.value();
  }
  damping.accept(0.5);
  EXPECT_DOUBLE_EQ(damping.value(), before);
  damping.refuse();
  EXPECT_LT(damping.value() / before, growth);
}

TEST(Damping, FallsWithAGoodStepButNotRightAfterARefusal) {
  Damping damping;
  for (int k = 0; k < 5; ++k) damping.refuse();
  const double held = damping.value();
  damping.accept(1.0);
  EXPECT_DOUBLE_EQ(damping.value(), held);
  damping.accept(1.0);
  EXPECT_LT(damping.value(), 0.2 * held);
}

TEST(Damping, GrowsAfterAStepThatGainsLittleOfWhatWasPromised) {
  Damping damping;
  for (int k = 0; k < 5; ++k) damping.refuse();
  const double held = damping.value();
  damping.accept(0.05);
  EXPECT_GT(damping.value(), 1.5 * held);
}

TEST(Damping, IsSpentAfterAFewRefusals) {
  Damping damping;
  int refusals = 0;
  while (!damping.is_spent()) {
    damping.refuse();
    ++refusals;
  }
  EXPECT_LT(refusals, 12);
  damping = Damping();
  int raised = 0;
  while (!damping.is_spent()) {
    damping.raise();
    ++raised;
  }
  EXPECT_LT(raised, 30);
}

}  // namespace
}  // namespace flank::internal
