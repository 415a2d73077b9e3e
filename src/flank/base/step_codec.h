/// The result of a finished step as plain values, so that a run can take it from a file in place of working it out again.
///
/// One function for each type goes through its members in a fixed order, and serves both ways:
///
///     void code(StepCodec& codec, ResidualSummary& summary) {
///       code(codec, summary.rms_mm);
///       code(codec, summary.largest_mm);
///     }
///
/// What is read back is what was written, bit by bit. Pointers and what can be made again at once are left out; the caller
/// puts them in.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace flank::internal {

/// The values of one step, in their order. Whole numbers and switches are among the numbers.
struct StepValues {
  std::vector<double> numbers;
  std::vector<std::string> texts;
  bool operator==(const StepValues&) const = default;
};

class StepCodec {
 public:
  /// Writes.
  StepCodec() = default;
  /// Reads. A value that is refused throws InputError, which says which value and what is needed.
  explicit StepCodec(StepValues values) : values_(std::move(values)), reading_(true) {}

  [[nodiscard]] bool reading() const { return reading_; }
  /// Any number but NaN: an estimate may be infinite.
  void number(double& value);
  void finite(double& value);
  /// In [low, high], at most 2^53.
  void whole(std::int64_t& value, std::int64_t low, std::int64_t high);
  void text(std::string& value);
  /// How many elements follow: no more than there are values left.
  [[nodiscard]] std::size_t count(std::size_t size);
  /// What the type asks of its values. Reading throws if it does not hold; a value that is written without it is not
  /// writable.
  void require(bool holds, const char* needed);
  /// Throws InputError if values are left.
  void end() const;

  /// False: what was written would be refused when it is read.
  [[nodiscard]] bool writable() const { return writable_; }
  [[nodiscard]] const StepValues& values() const { return values_; }

 private:
  [[nodiscard]] double next();
  [[noreturn]] void refuse(const std::string& needed) const;

  StepValues values_;
  bool reading_ = false, writable_ = true;
  std::size_t number_ = 0, text_ = 0;  ///< that were read
};

inline void code(StepCodec& codec, double& value) { codec.number(value); }
inline void code(StepCodec& codec, std::string& value) { codec.text(value); }
void code(StepCodec& codec, bool& value);
void code(StepCodec& codec, int& value);
void code(StepCodec& codec, std::size_t& value);

/// An enumeration of `count` values from zero on.
template <class Enum>
void code_choice(StepCodec& codec, Enum& value, int count) {
  auto index = static_cast<std::int64_t>(value);
  codec.whole(index, 0, count - 1);
  value = static_cast<Enum>(index);
}

template <class T>
void code(StepCodec& codec, std::optional<T>& value) {
  bool there = value.has_value();
  code(codec, there);
  if (codec.reading()) value = there ? std::optional<T>(T{}) : std::nullopt;
  if (there) code(codec, *value);
}

template <class T, std::size_t N>
void code(StepCodec& codec, std::array<T, N>& values) {
  for (T& value : values) code(codec, value);
}

/// Grows element by element: a size that is a lie costs no memory.
template <class T>
void code(StepCodec& codec, std::vector<T>& values) {
  const std::size_t size = codec.count(values.size());
  if (codec.reading()) values.clear();
  for (std::size_t k = 0; k < size; ++k) {
    if (codec.reading()) values.emplace_back();
    code(codec, values[k]);
  }
}

}  // namespace flank::internal
