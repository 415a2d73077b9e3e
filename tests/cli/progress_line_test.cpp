// The estimate of the time that is left, on runs whose end is known, and the line that shows it.
#include "progress_line.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace flank::cli {
namespace {

TEST(TimeLeft, OfAnEvenPaceIsExact) {
  TimeLeft left;
  for (int k = 0; k <= 5; ++k) left.report(10.0 + 2.0 * k, 0.1 * k);
  ASSERT_TRUE(left.seconds(20.0));
  EXPECT_NEAR(*left.seconds(20.0), 10.0, 1e-9);
  // It counts down between the reports.
  EXPECT_NEAR(*left.seconds(24.0), 6.0, 1e-9);
}

TEST(TimeLeft, IsNotToldBeforeItMeansSomething) {
  TimeLeft left;
  EXPECT_FALSE(left.seconds(0.0)) << "nothing was reported";
  left.report(0.0, 0.0);
  left.report(1.0, 0.1);
  left.report(2.0, 0.2);
  EXPECT_FALSE(left.seconds(2.0)) << "two moments are no agreement";
  left.report(3.0, 0.3);
  EXPECT_TRUE(left.seconds(3.0));
  TimeLeft quick, little;
  for (int k = 0; k <= 9; ++k) quick.report(0.1 * k, 0.1 * k);
  EXPECT_FALSE(quick.seconds(0.9)) << "a second is no time";
  for (int k = 0; k <= 4; ++k) little.report(1.0 * k, 0.01 * k);
  EXPECT_FALSE(little.seconds(4.0)) << "four per cent are no share";
}

TEST(TimeLeft, IsNotToldWhereThePaceChangesTooMuch) {
  // The first half takes a second, every tenth of the rest twenty.
  TimeLeft left;
  for (int k = 0; k <= 5; ++k) left.report(0.2 * k, 0.1 * k);
  left.report(21.0, 0.6);
  EXPECT_FALSE(left.seconds(21.0));
}

TEST(TimeLeft, IsNotToldOnceItHasPassed) {
  TimeLeft left;
  for (int k = 0; k <= 5; ++k) left.report(2.0 * k, 0.1 * k);
  EXPECT_TRUE(left.seconds(19.0));
  EXPECT_FALSE(left.seconds(21.0)) << "everybody sees that it was wrong";
}

TEST(TimeLeft, FollowsSlowly) {
  // A step that takes three times as long as the others moves the estimate, but by less than its own moment says.
  TimeLeft left;
  for (int k = 0; k <= 5; ++k) left.report(10.0 * k, 0.1 * k);
  left.report(80.0, 0.6);  // by the pace so far all would be done at 133, before at 100
  ASSERT_TRUE(left.seconds(80.0));
  EXPECT_GT(*left.seconds(80.0), 100.0 - 80.0);
  EXPECT_LT(*left.seconds(80.0), 133.0 - 80.0);
}

TEST(TimeLeft, BeginsAnewWhereTheShareFalls) {
  TimeLeft left;
  for (int k = 0; k <= 9; ++k) left.report(5.0 * k, 0.1 * k);
  ASSERT_TRUE(left.seconds(45.0));
  left.report(50.0, 0.1);
  EXPECT_FALSE(left.seconds(50.0));
  for (int k = 1; k <= 5; ++k) left.report(50.0 + 10.0 * k, 0.1 + 0.1 * k);
  ASSERT_TRUE(left.seconds(100.0));
  EXPECT_NEAR(*left.seconds(100.0), 40.0, 1e-9);
}

TEST(TimeLeft, AnotherStageAtTheSameShareSaysNothing) {
  TimeLeft left;
  for (int k = 0; k <= 5; ++k) {
    left.report(2.0 * k, 0.1 * k);
    left.report(2.0 * k, 0.1 * k);
  }
  EXPECT_NEAR(left.seconds(10.0).value_or(0.0), 10.0, 1e-9);
}

TEST(TimeLeft, IsToldInStepsInWhichItCanBeRight) {
  EXPECT_EQ(time_left_text(4.0), "a few seconds left");
  EXPECT_EQ(time_left_text(41.3), "about 40 s left");
  EXPECT_EQ(time_left_text(88.0), "about 90 s left");
  EXPECT_EQ(time_left_text(200.0), "about 3 min left");
  EXPECT_EQ(time_left_text(5000.0), "about 83 min left");
  EXPECT_EQ(time_left_text(9000.0), "about 2.5 h left");
}

TEST(ProgressLine, SaysWhatIsKnown) {
  ProgressLine line;
  EXPECT_EQ(line.line("starts", 0.0, 0.0), "starts   0 %");
  line.found({.coverage = 0.9731, .deepest_mm = 0.001, .clean = true});
  EXPECT_EQ(line.line("polish", 0.2, 10.0), "polish  20 %, best 97.3 %");
  (void)line.line("polish", 0.4, 20.0);
  EXPECT_EQ(line.line("fine fit", 0.6, 30.0), "fine fit  60 %, best 97.3 %, about 20 s left");
}

TEST(ProgressLine, KeepsTheBest) {
  ProgressLine line;
  line.found({.coverage = 0.8, .deepest_mm = 0.44, .clean = false});
  EXPECT_EQ(line.line("polish", 0.1, 0.0), "polish  10 %, best 80.0 %, gouging by 0.44 mm");
  line.found({.coverage = 0.3, .deepest_mm = 0.0, .clean = true});
  EXPECT_EQ(line.line("polish", 0.1, 0.0), "polish  10 %, best 80.0 %, gouging by 0.44 mm") << "less than half";
  line.found({.coverage = 0.5, .deepest_mm = 0.0, .clean = true});
  line.found({.coverage = 0.9, .deepest_mm = 0.1, .clean = false});
  line.found({.coverage = 0.4, .deepest_mm = 0.0, .clean = true});
  EXPECT_EQ(line.line("polish", 0.1, 0.0), "polish  10 %, best 50.0 %");
}

TEST(ProgressJson, NeverFalls) {
  ProgressLine line;
  double before = 0.0;
  for (const double share : {0.0, 0.3, 0.6, 0.1, 0.5, 0.7, 2.0}) {
    const nlohmann::json told = nlohmann::json::parse(line.json("fit", share, 10.0 * share));
    EXPECT_GE(told.at("share"), before) << share;
    before = told.at("share");
  }
  EXPECT_EQ(before, 1.0);
}

TEST(ProgressJson, SaysWhatIsKnown) {
  ProgressLine line;
  const nlohmann::json first = nlohmann::json::parse(line.json("read", 0.0, 0.0));
  EXPECT_EQ(first, nlohmann::json({{"stage", "read"}, {"share", 0.0}, {"eta_s", nullptr}, {"best", nullptr}}));
  line.found({.coverage = 0.9731, .deepest_mm = 0.25, .clean = false});
  for (int k = 1; k <= 5; ++k) (void)line.json("fit", 0.1 * k, 10.0 * k);
  const nlohmann::json told = nlohmann::json::parse(line.json("polish", 0.5, 50.0));
  EXPECT_EQ(told.at("stage"), "polish");
  EXPECT_EQ(told.at("eta_s"), 50.0);
  EXPECT_EQ(told.at("best"), nlohmann::json({{"coverage", 0.9731}, {"deepest_mm", 0.25}, {"clean", false}}));
}

}  // namespace
}  // namespace flank::cli
