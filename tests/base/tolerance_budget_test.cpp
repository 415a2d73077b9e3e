// What each link between a planner and the judge may use up, added up; and that nobody keeps a share of his own.
#include "flank/base/tolerance_budget.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <regex>
#include <string>
#include <vector>

namespace flank::internal {
namespace {

constexpr double kRounding = 1e-12;

TEST(ToleranceBudget, StripsOfAGivenToolKeepTheToleranceInTheTarget) {
  EXPECT_LE(worst_in_target(kToleranceBudget), 1.0 + kRounding);
}

TEST(ToleranceBudget, HalfPathsKeepTheTolerance) { EXPECT_LE(worst_of_halves(kToleranceBudget), 1.0 + kRounding); }

TEST(ToleranceBudget, FitsAimWithinTheTolerance) {
  EXPECT_LE(worst_of_fit_in_target(kToleranceBudget), 1.0 + kRounding);
  EXPECT_LE(worst_of_fit_in_other_faces(kToleranceBudget), 1.0 + kRounding);
  EXPECT_LE(worst_left_by_dead_zone(kToleranceBudget), 1.0 + kRounding);
}

// What a later step allows must not be less than what an earlier one aims at, or strips would be cut that were fine.
TEST(ToleranceBudget, EveryAimLiesBelowTheLimitThatJudgesIt) {
  const TargetDepthBudget& target = kToleranceBudget.target;
  EXPECT_LT(target.remembered, target.lift_of_certified * target.certified);
  EXPECT_LT(target.lift_of_certified, 1.0);
  EXPECT_LT(target.held_aim, target.held);
  EXPECT_LT(target.held, target.certified);
  EXPECT_LT(target.certified, target.last_look());
  const OtherFacesBudget& others = kToleranceBudget.others;
  EXPECT_LT(others.growing, others.aim);
  EXPECT_LT(others.aim, others.certified);
  EXPECT_LT(others.certified, others.last_look);
  const FitBudget& fit = kToleranceBudget.fit;
  EXPECT_LE(fit.dead_zone, fit.dead_zone_axis);
  EXPECT_LE(fit.exact_overcut, fit.settled_overcut);
  EXPECT_LE(fit.settled_overcut, fit.overcut);
  EXPECT_LT(kToleranceBudget.cavity.aim, kToleranceBudget.cavity.sides);
  EXPECT_LT(kToleranceBudget.cavity.sides, kToleranceBudget.cavity.halves);
}

// A link that a chain forgot would let the sum pass whatever its share is.
TEST(ToleranceBudget, EveryLinkCountsInItsChains) {
  using Chain = double (*)(const ToleranceBudget&);
  struct Link {
    const char* name;
    std::function<double&(ToleranceBudget&)> share;
    std::vector<Chain> chains;
    double sign = 1.0;
  };
  const std::vector<Link> links = {
      {"chord",
       [](ToleranceBudget& b) -> double& { return b.chord; },
       {worst_in_target, worst_in_other_faces, worst_of_shank, worst_of_fit_in_target, worst_of_fit_in_other_faces,
        worst_left_by_dead_zone}},
      {"certified", [](ToleranceBudget& b) -> double& { return b.target.certified; }, {worst_in_target}},
      {"between poses", [](ToleranceBudget& b) -> double& { return b.target.between_poses; }, {worst_in_target}},
      {"between samples", [](ToleranceBudget& b) -> double& { return b.target.between_samples; }, {worst_in_target}},
      {"last look",
       [](ToleranceBudget& b) -> double& { return b.others.last_look; },
       {worst_in_other_faces, worst_of_shank}},
      {"triangles", [](ToleranceBudget& b) -> double& { return b.others.triangles; }, {worst_in_other_faces}},
      {"triangles of the target", [](ToleranceBudget& b) -> double& { return b.shank.triangles; }, {worst_of_shank}},
      {"spare", [](ToleranceBudget& b) -> double& { return b.shank.spare; }, {worst_of_shank}, -1.0},
      {"allowance",
       [](ToleranceBudget& b) -> double& { return b.others.fit_allowance; },
       {worst_of_fit_in_other_faces}},
      {"soft term", [](ToleranceBudget& b) -> double& { return b.others.soft_term; }, {worst_of_fit_in_other_faces}},
      {"overcut", [](ToleranceBudget& b) -> double& { return b.fit.overcut; }, {worst_of_fit_in_target}},
      {"between samples",
       [](ToleranceBudget& b) -> double& { return b.fit.between_samples; },
       {worst_of_fit_in_target}},
      {"halves", [](ToleranceBudget& b) -> double& { return b.cavity.halves; }, {worst_of_halves}},
      {"between places", [](ToleranceBudget& b) -> double& { return b.cavity.between_places; }, {worst_of_halves}},
      {"chord of halves", [](ToleranceBudget& b) -> double& { return b.cavity.half_chord; }, {worst_of_halves}},
      {"dead zone", [](ToleranceBudget& b) -> double& { return b.fit.dead_zone_axis; }, {worst_left_by_dead_zone}},
  };
  for (const Link& link : links) {
    SCOPED_TRACE(link.name);
    for (const Chain chain : link.chains) {
      ToleranceBudget budget;
      const double before = chain(budget);
      EXPECT_GT(link.share(budget), 0.0);
      link.share(budget) += 0.25;
      EXPECT_NEAR(chain(budget) - before, link.sign * 0.25, kRounding);
    }
  }
}

// "0.3 * tolerance_mm" in the middle of a planner is a share that the sums above do not see.
TEST(ToleranceBudget, NoPlannerMultipliesTheToleranceByABareNumber) {
  const std::regex product(R"((^|[^\w.])\d+(\.\d*)?(e-?\d+)? \* ([a-z_]+\.)*tolerance|tolerance\w* \* \d)");
  int files = 0;
  for (const char* room : {"fit", "strip", "cover", "tool_choice", "trochoid", "obstacle", "setup", "pipeline"}) {
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::string(FLANK_SOURCE_DIR) + "/src/flank/" + room)) {
      if (entry.path().extension() != ".cpp") continue;
      ++files;
      std::ifstream in(entry.path());
      std::string line;
      for (int number = 1; std::getline(in, line); ++number) {
        if (line.find("tolerance") == std::string::npos) continue;
        EXPECT_FALSE(std::regex_search(line.substr(0, line.find("//")), product))
            << entry.path().string() << ":" << number << ": " << line;
      }
    }
  }
  EXPECT_GT(files, 30);
}

}  // namespace
}  // namespace flank::internal
