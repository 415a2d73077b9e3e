// Work is counted the same for any number of threads, and steps that are taken from a journal count.
#include "flank/base/work_count.h"

#include <gtest/gtest.h>

#include "flank/base/journal.h"
#include "flank/base/parallel.h"
#include "flank/threads.h"

namespace flank::internal {
namespace {

/// What a loop of loops does: 12 * (3 + 5 * 7) looks.
std::uint64_t nested() {
  const std::uint64_t before = work_done();
  parallel_for(12, [](std::size_t) {
    count_work(3);
    parallel_for(5, [](std::size_t) { count_work(7); });
  });
  return work_done() - before;
}

TEST(WorkCount, LoopsWithinLoopsCountOnceForAnyNumberOfThreads) {
  for (const int threads : {1, 2, 4}) {
    set_thread_count(threads);
    for (int k = 0; k < 50; ++k) ASSERT_EQ(nested(), 12u * (3u + 5u * 7u)) << threads << " threads";
  }
  set_thread_count(0);
}

TEST(WorkCount, ALimitedProgressEndsAtItsLimitAndWithTheOtherOne) {
  bool cancelled = false;
  Progress whole;
  whole.cancelled = [&] { return cancelled; };
  count_work(1000);  // what was done before is not of the calculation
  const Progress part = limited(whole, 10.0);
  count_work(9);
  EXPECT_FALSE(part.stop());
  count_work(1);
  EXPECT_TRUE(part.stop());
  EXPECT_FALSE(whole.stop());
  const Progress other = limited(whole, 1e300);
  cancelled = true;
  EXPECT_TRUE(other.stop());
}

/// Two steps; what was done for them, and how many were worked out.
std::pair<std::uint64_t, int> two_steps(const Progress& progress) {
  std::atomic<int> worked = 0;  // steps side by side
  const std::uint64_t before = work_done();
  const auto step = [&](int looks) {
    return [&worked, looks] {
      ++worked;
      count_work(static_cast<std::uint64_t>(looks));
      return 1.5;
    };
  };
  (void)journaled(progress, "first", step(20));
  (void)journaled_for(
      progress, "second", 3, [&](std::size_t k) { return step(static_cast<int>(k))(); },
      [](std::size_t k) { return k; });
  return {work_done() - before, worked.load()};
}

TEST(WorkCount, StepsOfAnEarlierRunCountAsIfTheyWereDone) {
  Progress first;
  first.journal = std::make_shared<Progress::Journal>();
  const JournalKey key{"version", "job", "part"};
  first.journal->begin(key);
  ASSERT_EQ(two_steps(first), std::pair(std::uint64_t{23}, 4));
  Progress again;
  again.journal = std::make_shared<Progress::Journal>(key, first.journal->steps(), "journal");
  again.journal->begin(key);
  EXPECT_EQ(two_steps(again), std::pair(std::uint64_t{23}, 0));
}

}  // namespace
}  // namespace flank::internal
