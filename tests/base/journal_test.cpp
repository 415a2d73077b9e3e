// A run that goes on takes the steps that an earlier one finished, and no other ones.
#include "flank/base/journal.h"

#include <gtest/gtest.h>

#include <memory>

#include "flank/threads.h"

namespace flank::internal {
namespace {

const JournalKey kKey{"1.0", "job", "part"};

/// A run of three steps, the second of which consists of two. It can be stopped at any of them.
class ThreeSteps {
 public:
  explicit ThreeSteps(std::vector<JournalStep> earlier = {}) {
    progress_.journal = std::make_shared<Journal>(kKey, std::move(earlier), "resume.json");
    progress_.cancelled = [this] { return done_ >= stop_at_; };
  }

  double run(int stop_at = 1000, double first_input = 1.0) {
    stop_at_ = stop_at;
    const double a = step("a", first_input);
    const double b = journaled(
        progress_, "b", [&] { return step("b1", a) + step("b2", a); }, a);
    return b + step("c", b);
  }

  [[nodiscard]] int done() const { return done_; }
  [[nodiscard]] std::vector<JournalStep> steps() const { return progress_.journal->steps(); }
  [[nodiscard]] std::string names() const {
    std::string all;
    for (const JournalStep& step : steps()) all += step.name + " ";
    return all;
  }

 private:
  double step(const char* name, double input) {
    const auto work = [&] {
      ++done_;
      return input / 3.0;
    };
    return journaled(progress_, name, work, input);
  }

  Progress progress_;
  int done_ = 0, stop_at_ = 1000;
};

TEST(Journal, AStepOfStepsStandsInTheirPlace) {
  ThreeSteps whole;
  (void)whole.run();
  EXPECT_EQ(whole.done(), 4);
  EXPECT_EQ(whole.names(), "a b c ");
}

TEST(Journal, WhereverARunIsStoppedAnotherOneGoesOn) {
  ThreeSteps whole;
  const double result = whole.run();
  const char* finished[] = {"", "", "a ", "a b1 ", "a b "};
  for (int stop_at = 1; stop_at <= 4; ++stop_at) {
    ThreeSteps stopped;
    (void)stopped.run(stop_at);
    EXPECT_EQ(stopped.names(), finished[stop_at]) << "the step that was cut short is not finished";
    ThreeSteps on(stopped.steps());
    EXPECT_EQ(on.run(), result);
    EXPECT_EQ(on.done(), 4 - (stop_at - 1)) << stop_at;
    EXPECT_EQ(on.names(), whole.names());
  }
}

TEST(Journal, ARunThatIsStoppedSoonerKeepsWhatTheEarlierOneHad) {
  ThreeSteps stopped;
  (void)stopped.run(4);
  ThreeSteps again(stopped.steps());
  (void)again.run(0);
  EXPECT_EQ(again.names(), stopped.names());
}

TEST(Journal, OtherInputsAreAnotherStep) {
  ThreeSteps stopped;
  (void)stopped.run(4);
  ThreeSteps other(stopped.steps());
  ThreeSteps fresh;
  EXPECT_EQ(other.run(1000, 2.0), fresh.run(1000, 2.0));
  EXPECT_EQ(other.done(), 4) << "nothing was taken";
  EXPECT_EQ(other.names(), "a b c ");
}

TEST(Journal, DamageIsRefusedWithItsPlace) {
  ThreeSteps stopped;
  (void)stopped.run(4);
  std::vector<JournalStep> steps = stopped.steps();
  steps[1].result.numbers.clear();
  ThreeSteps on(steps);
  try {
    (void)on.run();
    ADD_FAILURE() << "not refused";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()), "resume.json: step 2 (b): number 0, text 0: expected a further number");
  }
}

TEST(Journal, IsOfOneRun) {
  const auto refusal = [](const JournalKey& key) -> std::string {
    try {
      Journal(kKey, {}, "resume.json").begin(key);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(refusal(kKey), "");
  EXPECT_NE(refusal({"1.1", "job", "part"}).find("resume.json: is of version 1.0, and this is 1.1"), std::string::npos);
  EXPECT_NE(refusal({"1.0", "another", "part"}).find("is of another job"), std::string::npos);
  EXPECT_NE(refusal({"1.0", "job", "another"}).find("is of another part"), std::string::npos);
  Journal fresh;
  fresh.begin(kKey);
  EXPECT_EQ(fresh.key(), kKey);
  // What a run plans on the way, as once more with a shank, is no run of its own.
  fresh.begin({"1.0", "another", "part"});
  EXPECT_EQ(fresh.key(), kKey);
}

TEST(Journal, StepsSideBySideAreTakenOneByOne) {
  constexpr std::size_t kCount = 5;
  const auto work = [](std::size_t k) { return static_cast<double>(k) / 7.0; };
  const auto input = [](std::size_t k) { return k; };
  Progress first;
  first.journal = std::make_shared<Journal>(kKey, std::vector<JournalStep>{}, "");
  // Of batches of other sizes.
  const std::vector<double> all = journaled_for(first, "tool", kCount, work, input);
  std::vector<JournalStep> some = first.journal->steps();
  ASSERT_EQ(some.size(), kCount);
  some.resize(2);
  Progress second;
  second.journal = std::make_shared<Journal>(kKey, some, "");
  std::vector<char> worked(kCount, 0);
  const auto counted = [&](std::size_t k) {
    worked[k] = 1;
    return work(k);
  };
  EXPECT_EQ(journaled_for(second, "tool", kCount, counted, input), all);
  EXPECT_EQ(worked, (std::vector<char>{0, 0, 1, 1, 1}));
  EXPECT_EQ(second.journal->steps().size(), kCount);
  EXPECT_EQ(journaled_for(Progress(), "tool", kCount, work, input), all) << "without a journal";
}

TEST(Journal, TwoListsOfTextsAreNotAlike) {
  EXPECT_NE(fingerprint({{}, {"ab", "c"}}), fingerprint({{}, {"a", "bc"}}));
  EXPECT_NE(fingerprint({{0.0}, {}}), fingerprint({{-0.0}, {}}));
}

}  // namespace
}  // namespace flank::internal
