// What is read back is what was written; what is none of it is refused with its place.
#include "flank/base/step_codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "flank/error.h"

namespace flank::internal {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

enum class Colour { kRed, kGreen };

/// One member of every kind.
struct Sample {
  double number = 0.0;
  bool on = false;
  int count = 0;
  std::string text;
  std::optional<double> maybe;
  std::array<double, 2> pair{};
  std::vector<std::vector<std::size_t>> lists;
  Colour colour = Colour::kRed;
  bool operator==(const Sample&) const = default;
};

void code(StepCodec& codec, Sample& sample) {
  code(codec, sample.number);
  code(codec, sample.on);
  code(codec, sample.count);
  code(codec, sample.text);
  code(codec, sample.maybe);
  code(codec, sample.pair);
  code(codec, sample.lists);
  code_choice(codec, sample.colour, 2);
}

const Sample kSample{0.1, true, -7, "two\nlines", 1e-300, {-0.0, kInfinite}, {{}, {3, 4}}, Colour::kGreen};

StepValues written(Sample sample) {
  StepCodec codec;
  code(codec, sample);
  EXPECT_TRUE(codec.writable());
  return codec.values();
}

Sample read(const StepValues& values) {
  StepCodec codec(values);
  Sample sample;
  code(codec, sample);
  codec.end();
  return sample;
}

void expect_refused(const StepValues& values, const std::string& why) {
  try {
    (void)read(values);
    ADD_FAILURE() << "not refused: " << why;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
  }
}

TEST(StepCodec, ReadsWhatItWrote) {
  const Sample back = read(written(kSample));
  EXPECT_EQ(back, kSample);
  EXPECT_TRUE(std::signbit(back.pair[0]));
}

TEST(StepCodec, RefusesTooFewAndTooMany) {
  StepValues values = written(kSample);
  values.numbers.pop_back();
  expect_refused(values, "expected a further number");
  values = written(kSample);
  values.numbers.push_back(1.0);
  expect_refused(values, "expected nothing more");
  values = written(kSample);
  values.texts.clear();
  expect_refused(values, "expected a further text");
}

TEST(StepCodec, RefusesEveryNumberThatIsNone) {
  const StepValues good = written(kSample);
  for (std::size_t k = 0; k < good.numbers.size(); ++k) {
    StepValues bad = good;
    bad.numbers[k] = std::nan("");
    EXPECT_THROW((void)read(bad), InputError) << "number " << k;
  }
}

TEST(StepCodec, RefusesWhatIsOutOfItsRange) {
  const StepValues good = written(kSample);
  // In the order of the members: number, switch, count, ...
  for (const auto& [k, value] : {std::pair<std::size_t, double>{1, 2.0}, {2, 0.5}, {2, 1e10}, {2, kInfinite}}) {
    StepValues bad = good;
    bad.numbers[k] = value;
    EXPECT_THROW((void)read(bad), InputError) << "number " << k << " = " << value;
  }
  StepValues bad = good;
  bad.numbers.back() = 2.0;  // a third colour
  EXPECT_THROW((void)read(bad), InputError);
}

TEST(StepCodec, BelievesNoSize) {
  std::vector<std::vector<double>> lists;
  StepCodec codec(StepValues{{1e15}, {}});
  EXPECT_THROW(code(codec, lists), InputError);
  EXPECT_TRUE(lists.empty());
}

TEST(StepCodec, WhatWouldBeRefusedIsNotWritable) {
  StepCodec none;
  double nan = std::nan("");
  code(none, nan);
  EXPECT_FALSE(none.writable());
  StepCodec finite;
  double infinite = kInfinite;
  finite.finite(infinite);
  EXPECT_FALSE(finite.writable());
  StepCodec choice;
  auto third = static_cast<Colour>(2);
  code_choice(choice, third, 2);
  EXPECT_FALSE(choice.writable());
}

}  // namespace
}  // namespace flank::internal
