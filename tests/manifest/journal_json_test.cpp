// resume.json reads back bit by bit, or is refused with its place.
#include "flank/manifest/journal_json.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace flank::internal {
namespace {

const std::string kHash(64, 'a'), kOther(64, 'b');

Journal sample(std::vector<double> numbers) {
  return {{"1.0", kHash, kOther}, {{"polish", kOther, {std::move(numbers), {"a \"text\"", ""}}}}, "made"};
}

void expect_refused(const std::string& text, const std::string& why) {
  try {
    (void)journal_from_json(text, "out/resume.json");
    ADD_FAILURE() << "not refused: " << text;
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.find("out/resume.json: "), 0u) << what;
    EXPECT_NE(what.find(why), std::string::npos) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
  }
}

/// The text with one part of it replaced.
std::string with(std::string text, const std::string& part, const std::string& by) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return text.replace(at, part.size(), by);
}

TEST(JournalJson, ReadsBackBitByBit) {
  std::vector<double> numbers{0.1,
                              -0.0,
                              1.0 / 3.0,
                              std::numeric_limits<double>::denorm_min(),
                              std::numeric_limits<double>::max(),
                              std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity(),
                              9007199254740993.0};
  std::uint64_t bits = 0x3ff0000000000001;
  for (int k = 0; k < 1000; ++k, bits = bits * 6364136223846793005 + 1442695040888963407) {
    const auto number = std::bit_cast<double>(bits);
    if (std::isfinite(number)) numbers.push_back(number);
  }
  const Journal back = journal_from_json(journal_to_json(sample(numbers)), "f");
  EXPECT_EQ(back.key(), (JournalKey{"1.0", kHash, kOther}));
  const std::vector<JournalStep> steps = back.steps();
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_EQ(steps[0].name, "polish");
  EXPECT_EQ(steps[0].inputs, kOther);
  EXPECT_EQ(steps[0].result.texts, (std::vector<std::string>{"a \"text\"", ""}));
  ASSERT_EQ(steps[0].result.numbers.size(), numbers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(steps[0].result.numbers[k]), std::bit_cast<std::uint64_t>(numbers[k]));
}

TEST(JournalJson, RefusesDamage) {
  const std::string good = journal_to_json(sample({0.25, 7.0}));
  EXPECT_NO_THROW((void)journal_from_json(good, "f"));
  expect_refused("", "not the steps of a run");
  expect_refused("[]", "not the steps of a run");
  expect_refused(with(good, "resume/1", "resume/2"), "expected schema \"openflank/resume/1\"");
  expect_refused(with(good, "0.25", "NaN"), "parse error");
  expect_refused(with(good, "0.25", "null"), "step 1: expected a number, not null");
  expect_refused(with(good, "0.25", "\"nan\""), "step 1: expected a number");
  expect_refused(with(good, "0.25", "1e999"), "number overflow");
  expect_refused(with(good, "0.25", "[1,2]"), "step 1: expected a number, not [1,2]");
  expect_refused(with(good, kHash, "short"), "64 hexadecimal digits");
  expect_refused(with(good, "\"name\"", "\"more\":1,\"name\""), "step 1: unknown keys");
  expect_refused(with(good, "\"version\"", "\"more\":1,\"version\""), "unknown keys");
  expect_refused(with(good, "\"texts\"", "\"text\""), "step 1: ");
}

TEST(JournalJson, RefusesEveryCut) {
  const std::string good = journal_to_json(sample({0.25}));
  for (std::size_t size = 0; size + 2 < good.size(); ++size)
    EXPECT_THROW((void)journal_from_json(good.substr(0, size), "f"), InputError) << size;
}

}  // namespace
}  // namespace flank::internal
