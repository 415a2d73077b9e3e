#include "flank/base/parallel.h"
#include "flank/threads.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace flank::internal {
namespace {

class Parallel : public ::testing::Test {
 protected:
  void TearDown() override { set_thread_count(0); }
};

std::vector<double> squares(std::size_t count) {
  std::vector<double> values(count, -1.0);
  parallel_for(count, [&](std::size_t i) { values[i] = std::sqrt(static_cast<double>(i)) * static_cast<double>(i); });
  return values;
}

TEST_F(Parallel, SameValuesForEveryThreadCount) {
  set_thread_count(1);
  const std::vector<double> one = squares(5000);
  for (const int threads : {2, 3, 8}) {
    set_thread_count(threads);
    EXPECT_EQ(squares(5000), one) << threads << " threads";
  }
}

TEST_F(Parallel, CallsEveryIndexOnce) {
  for (const int threads : {1, 2}) {
    set_thread_count(threads);
    std::vector<std::atomic<int>> calls(1001);
    parallel_for(calls.size(), [&](std::size_t i) { ++calls[i]; });
    for (const auto& n : calls) EXPECT_EQ(n.load(), 1);
  }
}

TEST_F(Parallel, BlocksTileTheRangeWhateverTheThreadCount) {
  for (const int threads : {1, 2}) {
    for (const std::size_t grain : {std::size_t{1}, std::size_t{7}, std::size_t{100}, std::size_t{1000}}) {
      set_thread_count(threads);
      std::vector<int> calls(100, 0);
      parallel_blocks(calls.size(), grain, [&](std::size_t begin, std::size_t end) {
        EXPECT_LE(end - begin, grain);
        EXPECT_EQ(begin % grain, 0u);
        for (std::size_t i = begin; i < end; ++i) ++calls[i];
      });
      EXPECT_EQ(calls, std::vector<int>(100, 1)) << "grain " << grain << ", " << threads << " threads";
    }
  }
}

TEST_F(Parallel, GrainZeroMeansOne) {
  std::atomic<int> blocks{0};
  parallel_blocks(5, 0, [&](std::size_t begin, std::size_t end) {
    EXPECT_EQ(end, begin + 1);
    ++blocks;
  });
  EXPECT_EQ(blocks.load(), 5);
}

TEST_F(Parallel, NothingToDoCallsNothing) {
  parallel_for(0, [](std::size_t) { FAIL() << "called"; });
}

TEST_F(Parallel, RethrowsWhatABodyThrows) {
  for (const int threads : {1, 2}) {
    set_thread_count(threads);
    EXPECT_THROW(parallel_for(100,
                              [](std::size_t i) {
                                if (i == 37) throw std::out_of_range("37");
                              }),
                 std::out_of_range);
    // The loops still work afterwards.
    EXPECT_EQ(squares(10).size(), 10u);
  }
}

TEST_F(Parallel, LoopsNest) {
  set_thread_count(2);
  std::vector<std::vector<int>> table(8, std::vector<int>(16, 0));
  parallel_for(table.size(), [&](std::size_t i) {
    parallel_for(table[i].size(), [&](std::size_t j) { table[i][j] = static_cast<int>(i * j); });
  });
  for (std::size_t i = 0; i < table.size(); ++i) {
    EXPECT_EQ(std::accumulate(table[i].begin(), table[i].end(), 0), static_cast<int>(i) * 120);
  }
}

TEST_F(Parallel, ReportsTheThreadCount) {
  set_thread_count(3);
  EXPECT_EQ(thread_count(), 3);
  set_thread_count(0);
  EXPECT_GE(thread_count(), 1);
}

}  // namespace
}  // namespace flank::internal
