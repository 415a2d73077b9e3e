#include "flank/base/step_codec.h"

#include <cmath>

#include "flank/error.h"

namespace flank::internal {
namespace {

constexpr std::int64_t kMostWhole = std::int64_t{1} << 53;

}  // namespace

void StepCodec::refuse(const std::string& needed) const {
  throw InputError("number " + std::to_string(number_) + ", text " + std::to_string(text_) + ": " + needed);
}

double StepCodec::next() {
  if (number_ == values_.numbers.size()) refuse("expected a further number");
  return values_.numbers[number_++];
}

void StepCodec::number(double& value) {
  if (reading_)
    value = next();
  else
    values_.numbers.push_back(value);
  require(!std::isnan(value), "expected a number");
}

void StepCodec::finite(double& value) {
  number(value);
  require(std::isfinite(value), "expected a finite number");
}

void StepCodec::whole(std::int64_t& value, std::int64_t low, std::int64_t high) {
  if (!reading_) {
    require(value >= low && value <= high && std::abs(value) <= kMostWhole, "expected a whole number in its range");
    values_.numbers.push_back(static_cast<double>(value));
    return;
  }
  const double found = next();
  // In this order: a number out of range must not become an integer.
  require(std::abs(found) <= static_cast<double>(kMostWhole) && found == std::floor(found), "expected a whole number");
  value = static_cast<std::int64_t>(found);
  require(value >= low && value <= high, "expected a whole number in its range");
}

void StepCodec::text(std::string& value) {
  if (!reading_) {
    values_.texts.push_back(value);
    return;
  }
  if (text_ == values_.texts.size()) refuse("expected a further text");
  value = values_.texts[text_++];
}

std::size_t StepCodec::count(std::size_t size) {
  auto counted = static_cast<std::int64_t>(size);
  const std::size_t left = values_.numbers.size() - number_ + values_.texts.size() - text_;
  whole(counted, 0, reading_ ? static_cast<std::int64_t>(left) : kMostWhole);
  return static_cast<std::size_t>(counted);
}

void StepCodec::require(bool holds, const char* needed) {
  if (holds) return;
  if (reading_) refuse(needed);
  writable_ = false;
}

void StepCodec::end() const {
  if (number_ != values_.numbers.size() || text_ != values_.texts.size()) refuse("expected nothing more");
}

void code(StepCodec& codec, bool& value) {
  std::int64_t number = value ? 1 : 0;
  codec.whole(number, 0, 1);
  value = number != 0;
}

void code(StepCodec& codec, int& value) {
  std::int64_t number = value;
  codec.whole(number, std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
  value = static_cast<int>(number);
}

void code(StepCodec& codec, std::size_t& value) {
  auto number = static_cast<std::int64_t>(value);
  codec.whole(number, 0, kMostWhole);
  value = static_cast<std::size_t>(number);
}

}  // namespace flank::internal
