// TILE: the set of strips against every subset, the price, the limits, and the strips that are grown on the way.
#include "flank/cover/tiles/tile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "cover/cover_targets.h"
#include "flank/base/random.h"
#include "flank/cover/tiles/smooth.h"
#include "flank/threads.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

/// Strips as sets of cells. Under a lid no strip can be grown: what is chosen comes from the pool alone.
class Choice : public ::testing::Test {
 protected:
  void make_cells(int count, Random* random = nullptr) {
    for (int k = 0; k < count; ++k) {
      SurfaceSample cell{Vec3(10.0 * k / count, 5.0, 0.0), Vec3::UnitZ(), random ? random->uniform(0.5, 1.5) : 1.0};
      samples_.cells.push_back(cell);
      samples_.area += cell.area;
    }
  }
  CoverStrip strip(std::vector<int> cells) const {
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    CoverStrip strip;
    strip.motion = testing::straight_motion(5.0);
    strip.cells = std::move(cells);
    for (const int k : strip.cells) strip.area += samples_.cells[static_cast<std::size_t>(k)].area;
    return strip;
  }
  CoverStrip range(int first, int end) const {
    std::vector<int> cells(static_cast<std::size_t>(end - first));
    std::iota(cells.begin(), cells.end(), first);
    return strip(cells);
  }
  /// Pieces of a ring of 60 cells and a few stray cells each, in a pool of `count`.
  std::vector<CoverStrip> random_pool(int count, Random& random) {
    samples_ = {};
    make_cells(60, &random);
    std::vector<CoverStrip> pool;
    for (int k = 0; k < count; ++k) {
      const int first = static_cast<int>(random.uniform(0, 60)), length = static_cast<int>(random.uniform(5, 28));
      std::vector<int> cells;
      for (int i = 0; i < length; ++i) cells.push_back((first + i) % 60);
      for (int i = 0; i < 3; ++i) cells.push_back(static_cast<int>(random.uniform(0, 60)));
      pool.push_back(strip(cells));
    }
    return pool;
  }
  TileScene scene() const { return {*target_, tool_.radial, samples_, guard_, options_}; }
  double worth(const std::vector<CoverStrip>& pool, const StripSet& set) const { return set_value(scene(), pool, set); }
  StripSet choose(std::vector<CoverStrip> pool) const {
    const std::size_t before = pool.size();
    StripSet set = choose_set(scene(), pool);
    EXPECT_EQ(pool.size(), before) << "nothing can be grown under a lid";
    return set;
  }
  double best_of_all_subsets(const std::vector<CoverStrip>& pool) const {
    double best = 0.0;
    for (unsigned bits = 0; bits < 1u << pool.size(); ++bits) {
      StripSet set;
      for (int k = 0; k < static_cast<int>(pool.size()); ++k)
        if ((bits >> k & 1u) != 0) set.push_back(k);
      best = std::max(best, worth(pool, set));
    }
    return best;
  }

  std::unique_ptr<Target> target_ = testing::flat_target(0.0, 10.0, 0.0, 10.0);
  Tool tool_ = testing::cylinder(1.0, 5.0);
  Obstacles lid_ = testing::lid_at(0.5);
  PoseGuard guard_{tool_, lid_, -0.001};
  CoverSamples samples_;
  CoverOptions options_;
};

TEST_F(Choice, ComesUpToTheBestOfAllSubsets) {
  Random random(101);
  options_.strip_price = 0.04;
  constexpr int kTrials = kSanitized ? 10 : 40;
  int best = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::vector<CoverStrip> pool = random_pool(8, random);
    const double all = best_of_all_subsets(pool), found = worth(pool, choose(pool));
    EXPECT_LE(found, all + 1e-12);
    EXPECT_GE(found, all - options_.strip_price) << "less than the price of a strip is lost";
    if (found > all - 1e-9) ++best;
  }
  EXPECT_GE(best, 9 * kTrials / 10) << "an exchange of one for one does not find every best set";
}

TEST_F(Choice, NoExchangeAdditionOrRemovalIsBetter) {
  Random random(102);
  options_.strip_price = 0.02;
  for (int trial = 0; trial < (kSanitized ? 10 : 40); ++trial) {
    const std::vector<CoverStrip> pool = random_pool(14, random);
    const StripSet set = choose(pool);
    const double value = worth(pool, set);
    EXPECT_EQ(std::set<int>(set.begin(), set.end()).size(), set.size()) << "no strip twice";
    for (std::size_t i = 0; i < set.size(); ++i) {
      StripSet fewer = set;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      EXPECT_LE(worth(pool, fewer), value + 1e-9);
      for (int k = 0; k < static_cast<int>(pool.size()); ++k) {
        StripSet other = set;
        other[i] = k;
        EXPECT_LE(worth(pool, other), value + 2e-6);
      }
    }
    for (int k = 0; k < static_cast<int>(pool.size()); ++k) {
      StripSet more = set;
      more.push_back(k);
      EXPECT_LE(worth(pool, more), value + 2e-6);
    }
  }
}

TEST_F(Choice, TheOrderOfThePoolDoesNotMatter) {
  Random random(103);
  options_.strip_price = 0.02;
  for (int trial = 0; trial < (kSanitized ? 5 : 20); ++trial) {
    const std::vector<CoverStrip> pool = random_pool(10, random);
    std::vector<int> order(pool.size());
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t k = order.size() - 1; k > 0; --k)
      std::swap(order[k], order[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(k) + 1.0))]);
    std::vector<CoverStrip> shuffled;
    for (const int k : order) shuffled.push_back(pool[static_cast<std::size_t>(k)]);
    // Sets that cover everything with as many strips are equally good.
    EXPECT_NEAR(worth(shuffled, choose(shuffled)), worth(pool, choose(pool)), 1e-12) << trial;
  }
}

TEST_F(Choice, TwoThatMeetAreBetterThanTheWidestAndTwoMore) {
  make_cells(100);
  options_.strip_price = 0.01;
  const std::vector<CoverStrip> pool = {range(24, 77), range(0, 50), range(50, 100)};
  const StripSet set = choose(pool);
  EXPECT_EQ(std::set<int>(set.begin(), set.end()), (std::set<int>{1, 2}));
  EXPECT_NEAR(worth(pool, set), 1.0 - 2.0 * 0.01, 1e-12);
}

TEST_F(Choice, TakesWhatIsWorthItsPriceAndNothingElse) {
  make_cells(100);
  const std::vector<CoverStrip> pool = {range(0, 40), range(40, 70), range(70, 90), range(90, 97), range(97, 100)};
  std::size_t last = 6;
  for (const auto& [price, count] :
       std::vector<std::pair<double, std::size_t>>{{0.0, 5}, {0.025, 5}, {0.035, 4}, {0.1, 3}, {0.25, 2}, {0.35, 1}}) {
    options_.strip_price = price;
    const StripSet set = choose(pool);
    EXPECT_EQ(set.size(), count) << price;
    EXPECT_LE(set.size(), last) << "a higher price never buys more";
    last = set.size();
    for (std::size_t k = 0; k < count; ++k)
      EXPECT_NE(std::find(set.begin(), set.end(), static_cast<int>(k)), set.end());
  }
}

TEST_F(Choice, IsEmptyWhereNothingIsWorthIt) {
  make_cells(100);
  options_.strip_price = 0.2;
  EXPECT_TRUE(choose({}).empty());
  EXPECT_TRUE(choose({range(0, 10), range(10, 25)}).empty());
}

TEST_F(Choice, TakesNoMoreThanTheMost) {
  make_cells(100);
  std::vector<CoverStrip> pool;
  for (int k = 0; k < 10; ++k) pool.push_back(range(10 * k, 10 * k + 10));
  pool.push_back(range(95, 100));
  for (const int most : {1, 3, 10}) {
    options_.most_strips = most;
    EXPECT_EQ(choose(pool).size(), static_cast<std::size_t>(most));
  }
}

TEST_F(Choice, AddsNothingBeyondEnoughCoverage) {
  make_cells(100);
  std::vector<CoverStrip> pool;
  for (int k = 0; k < 10; ++k) pool.push_back(range(10 * k, 10 * k + 10));
  for (const auto& [enough, count] : std::vector<std::pair<double, std::size_t>>{{0.25, 3}, {0.7, 7}, {1.0, 10}}) {
    options_.enough_coverage = enough;
    EXPECT_EQ(choose(pool).size(), count) << enough;
    EXPECT_EQ(additions(scene(), pool, {range(0, 10)}).size(), count - 1) << enough;
  }
}

TEST_F(Choice, SameForAnyNumberOfThreads) {
  Random random(104);
  const std::vector<CoverStrip> pool = random_pool(14, random);
  set_thread_count(1);
  const StripSet one = choose(pool);
  set_thread_count(3);
  const StripSet three = choose(pool);
  set_thread_count(0);
  EXPECT_EQ(one, three);
}

TEST_F(Choice, AdditionsAreTheGreatestGainsInTurn) {
  Random random(105);
  options_.strip_price = 0.03;
  for (int trial = 0; trial < 6; ++trial) {
    const std::vector<CoverStrip> pool = random_pool(12, random);
    const std::vector<CoverStrip> given = {pool[0], pool[1]};
    CellCount covered(samples_);
    for (const CoverStrip& strip : given) covered.add(strip);
    for (const CoverStrip& strip : additions(scene(), pool, given)) {
      double most = 0.0;
      for (const CoverStrip& other : pool) most = std::max(most, covered.gain(other));
      EXPECT_NEAR(covered.gain(strip), most, 1e-15);
      EXPECT_GT(most, options_.strip_price);
      covered.add(strip);
    }
    for (const CoverStrip& other : pool) EXPECT_LE(covered.gain(other), options_.strip_price);
  }
}

TEST_F(Choice, AdditionsCountTheStripsThatAreThere) {
  make_cells(100);
  options_.most_strips = 3;
  const std::vector<CoverStrip> pool = {range(20, 40), range(40, 60), range(60, 80)};
  EXPECT_EQ(additions(scene(), pool, {range(0, 10), range(10, 20)}).size(), 1u);
  EXPECT_TRUE(additions(scene(), pool, {range(0, 10), range(10, 15), range(15, 20)}).empty());
}

TEST_F(Choice, PruningLeavesOnlyWhatIsWorthItsPrice) {
  Random random(106);
  options_.strip_price = 0.05;
  for (int trial = 0; trial < 40; ++trial) {
    const std::vector<CoverStrip> pool = random_pool(10, random);
    const std::vector<CoverStrip> left = pruned(scene(), pool);
    CellCount covered(samples_);
    for (const CoverStrip& strip : left) covered.add(strip);
    for (const CoverStrip& strip : left) {
      covered.add(strip, -1);
      EXPECT_GE(covered.gain(strip), options_.strip_price);
      covered.add(strip);
    }
    const auto value = [&](const std::vector<CoverStrip>& strips) {
      return covered_share(samples_, strips) - options_.strip_price * static_cast<double>(strips.size());
    };
    EXPECT_GE(value(left), value(pool));
    // What is left is in its old order.
    std::size_t k = 0;
    for (const CoverStrip& strip : pool)
      if (k < left.size() && strip.cells == left[k].cells) ++k;
    EXPECT_EQ(k, left.size());
  }
}

TEST_F(Choice, PruningDropsTheLeastFirstAndNeverTheLast) {
  make_cells(100);
  options_.strip_price = 0.06;
  // Either of the first two makes up for most of the other: only the one that adds less goes.
  const std::vector<CoverStrip> left = pruned(scene(), {range(0, 54), range(5, 55), range(55, 100)});
  ASSERT_EQ(left.size(), 2u);
  EXPECT_EQ(left[0].cells.front(), 0);
  EXPECT_EQ(pruned(scene(), {range(0, 1)}).size(), 1u);
  EXPECT_EQ(pruned(scene(), {range(0, 1), range(0, 1)}).size(), 1u);
  EXPECT_TRUE(pruned(scene(), {}).empty());
}

/// A cylinder 16 mm long over a plane of 50 x 30 mm: one strip along x covers half of it and a little.
class Sheet : public ::testing::Test {
 protected:
  LineSeed seed(double x, double y) const { return {Vec3(x, y, 0.0), Vec3::UnitZ(), Vec3::UnitY(), 8.0}; }
  TileScene scene() const { return {*target_, tool_.radial, samples_, guard_, options_}; }

  std::unique_ptr<Target> target_ = testing::flat_target(0.0, 50.0, 0.0, 30.0);
  Tool tool_ = testing::cylinder(4.0, 16.0);
  CoverSamples samples_ = cover_samples(*target_, 1.0);
  PoseGuard guard_;
  CoverOptions options_;
};

TEST_F(Sheet, ASeedGrowsFromBorderToBorder) {
  const CandidatePool pool = grow_pool(scene(), {seed(20.0, 15.0)});
  EXPECT_EQ(pool.lines, 1);
  ASSERT_EQ(pool.strips.size(), 1u);
  EXPECT_NEAR(pool.strips[0].area, 50.0 * (16.0 + 2.0 * std::sqrt(2.0 * 4.0 * 0.01)), 50.0) << "to a row of cells";
  EXPECT_LE(pool.strips[0].overcut_mm, 0.01);
}

TEST_F(Sheet, ALineThatHangsOverTheBorderIsNone) {
  // Its upper 16 / 2 - 2 mm are past the border: less than four fifths are inside.
  const CandidatePool pool = grow_pool(scene(), {seed(20.0, 28.0), seed(20.0, 15.0), seed(20.0, 27.9)});
  EXPECT_EQ(pool.lines, 1);
  EXPECT_EQ(pool.strips.size(), 1u);
}

TEST_F(Sheet, ALineThatIsBlockedCountsAndGivesNoStrip) {
  const Obstacles lid = testing::lid_at(3.0);
  guard_ = PoseGuard(tool_, lid, -0.005);
  const CandidatePool pool = grow_pool(scene(), {seed(20.0, 15.0), seed(30.0, 15.0)});
  EXPECT_EQ(pool.lines, 2);
  EXPECT_TRUE(pool.strips.empty());
}

TEST_F(Sheet, StripsKeepTheOrderOfTheirSeedsOnAnyNumberOfThreads) {
  const std::vector<LineSeed> seeds = {seed(20.0, 9.0), seed(20.0, 28.0), seed(30.0, 21.0), seed(25.0, 15.0)};
  set_thread_count(1);
  const CandidatePool one = grow_pool(scene(), seeds);
  set_thread_count(3);
  const CandidatePool three = grow_pool(scene(), seeds);
  set_thread_count(0);
  ASSERT_EQ(one.strips.size(), 3u);
  ASSERT_EQ(three.strips.size(), 3u);
  const std::vector<double> heights = {9.0, 21.0, 15.0};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(one.strips[k].motion.pose(0.5).at(8.0).y(), heights[k], 0.5);
    EXPECT_EQ(one.strips[k].motion.tip.poles, three.strips[k].motion.tip.poles);
    EXPECT_EQ(one.strips[k].cells, three.strips[k].cells);
  }
}

TEST_F(Sheet, NeighboursAreGrownBesideTheFirst) {
  std::vector<CoverStrip> pool = grow_pool(scene(), {seed(25.0, 15.0)}).strips;
  ASSERT_EQ(pool.size(), 1u);
  const StripSet set = choose_set(scene(), pool);
  EXPECT_GT(pool.size(), 1u) << "they join the pool";
  EXPECT_LE(set.size(), 3u);
  EXPECT_GT(set_value(scene(), pool, set), 0.97 - 3.0 * options_.strip_price);
  for (const int k : set) EXPECT_LT(static_cast<std::size_t>(k), pool.size());
}

TEST_F(Sheet, AdditionsCloseTheGapThatStripsLeave) {
  const std::vector<CoverStrip> strips = grow_pool(scene(), {seed(25.0, 8.0)}).strips;
  ASSERT_EQ(strips.size(), 1u);
  const double before = covered_share(samples_, strips);
  ASSERT_LT(before, 0.6);
  std::vector<CoverStrip> all = strips;
  for (CoverStrip& strip : additions(scene(), {}, strips)) all.push_back(std::move(strip));
  EXPECT_GE(covered_share(samples_, all), 0.97);
  EXPECT_LE(all.size(), 3u);
}

}  // namespace
}  // namespace flank::internal
