/// The finished steps of a run: what a run that was stopped need not do again (docs/schema/resume.md).
///
/// Planners are deterministic, so the steps of a run that is taken up again are those of the run that was stopped, in the
/// same order, as far as that one came. A step may consist of steps: once it is finished it stands in their place.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "flank/base/parallel.h"
#include "flank/base/step_codec.h"
#include "flank/base/stopping.h"
#include "flank/base/work_count.h"
#include "flank/error.h"
#include "flank/progress.h"

namespace flank::internal {

/// Of which run: all that decides its steps.
struct JournalKey {
  std::string version;  ///< of the program
  std::string job;      ///< SHA-256 of what was asked for, and of the files that it names but the part
  std::string part;     ///< SHA-256 of the part
  bool operator==(const JournalKey&) const = default;
};

struct JournalStep {
  std::string name;    ///< "polish"
  std::string inputs;  ///< SHA-256 of what the step began with
  StepValues result;
};

}  // namespace flank::internal

/// For one thread: steps are asked for and added one after another.
class flank::Progress::Journal {
  using JournalKey = internal::JournalKey;
  using JournalStep = internal::JournalStep;

 public:
  /// Of a run from the beginning.
  Journal() = default;
  /// Of a run that goes on. `file`: for messages.
  Journal(JournalKey key, std::vector<JournalStep> earlier, std::string file)
      : key_(std::move(key)), earlier_(std::move(earlier)), file_(std::move(file)) {}

  [[nodiscard]] const std::optional<JournalKey>& key() const { return key_; }
  /// From here on the steps are of this run, those of whatever it plans on the way to its result among them: only the first call counts.
  /// Throws InputError if those that were read are of another.
  void begin(const JournalKey& key);

  /// The next step of the earlier run, if it has this name and these inputs: `read` gets its values. False if it has not. Throws InputError with
  /// the place if `read` refuses them.
  template <class Read>
  [[nodiscard]] bool take(const JournalStep& step, const Read& read) {
    if (!is_next(step)) return false;
    internal::StepCodec codec(earlier_[taken_].result);
    try {
      read(codec);
      codec.end();
    } catch (const Error& error) {
      refuse(error.what());
    }
    steps_.push_back(std::move(earlier_[taken_++]));
    return true;
  }
  /// How many steps there are; those that a step consists of come after.
  [[nodiscard]] std::size_t mark() const { return steps_.size(); }
  /// The step in the place of all since the mark.
  void add(std::size_t mark, JournalStep step);

  /// All finished steps. A run that was stopped before it came as far as the earlier one keeps what that had.
  [[nodiscard]] std::vector<JournalStep> steps() const;

 private:
  [[nodiscard]] bool is_next(const JournalStep& step) const;
  [[noreturn]] void refuse(const std::string& why) const;

  std::optional<JournalKey> key_;
  std::vector<JournalStep> steps_, earlier_;
  std::size_t taken_ = 0;  ///< of the earlier ones
  bool added_ = false, begun_ = false;
  std::string file_;
};

namespace flank::internal {

using Journal = Progress::Journal;

/// SHA-256 of values, bit by bit.
[[nodiscard]] std::string fingerprint(const StepValues& values);

/// The step without its result.
template <class... Inputs>
[[nodiscard]] JournalStep begun_step(const char* name, const Inputs&... inputs) {
  StepCodec codec;
  [[maybe_unused]] const auto add = [&](auto input) { code(codec, input); };
  (add(inputs), ...);
  return {name, fingerprint(codec.values()), {}};
}

/// The result of a step, and how much was done for it (work_count.h).
template <class Value>
void code_step(StepCodec& codec, Value& value, double& work) {
  code(codec, value);
  codec.finite(work);
}

/// Takes a step of an earlier run. What was done for it counts, so that a search that goes on ends where it would have ended.
template <class Value>
[[nodiscard]] bool take_step(Journal& journal, const JournalStep& step, Value& value) {
  double work = 0.0;
  if (!journal.take(step, [&](StepCodec& codec) { code_step(codec, value, work); })) return false;
  count_work(static_cast<std::uint64_t>(work));
  return true;
}

/// With its result, unless that could not be read back.
template <class Value>
void add_step(Journal& journal, std::size_t mark, JournalStep step, Value& value, std::uint64_t done) {
  StepCodec codec;
  auto work = static_cast<double>(done);
  code_step(codec, value, work);
  step.result = codec.values();
  if (codec.writable()) journal.add(mark, std::move(step));
}

/// The result of `work`: taken from the journal if an earlier run has finished this step, else worked out and added to it.
/// A step during which the run was stopped is not finished. `inputs`: what the result depends on beyond the run's key and
/// the steps before it, as far as it is a value. Without a journal it is `work()`. Not within parallel loops.
template <class Work, class... Inputs>
[[nodiscard]] auto journaled(const Progress& progress, const char* name, const Work& work, const Inputs&... inputs) {
  using Value = std::invoke_result_t<Work>;
  Journal* journal = progress.journal.get();
  if (journal == nullptr) return Value(work());
  Value value;
  JournalStep step = begun_step(name, inputs...);
  if (take_step(*journal, step, value)) return value;
  const std::size_t mark = journal->mark();
  const std::uint64_t before = work_done();
  value = work();
  if (!(progress.stop() || stopping())) add_step(*journal, mark, std::move(step), value, work_done() - before);
  return value;
}

/// The same for steps that are worked out side by side: work(k) for every k in [0, count), from inputs(k).
template <class Work, class Inputs>
[[nodiscard]] auto journaled_for(const Progress& progress, const char* name, std::size_t count, const Work& work,
                                 const Inputs& inputs) {
  using Value = std::invoke_result_t<Work, std::size_t>;
  Journal* journal = progress.journal.get();
  std::vector<Value> values(count);
  std::vector<JournalStep> steps;
  for (std::size_t k = 0; k < count && journal != nullptr; ++k) steps.push_back(begun_step(name, inputs(k)));
  std::size_t taken = 0;
  while (taken < steps.size() && take_step(*journal, steps[taken], values[taken])) ++taken;
  std::vector<std::uint64_t> done(count);
  parallel_for(count - taken, [&](std::size_t k) {
    const std::uint64_t before = work_done();
    values[taken + k] = work(taken + k);
    done[taken + k] = work_done() - before;
  });
  if (journal == nullptr || progress.stop() || stopping()) return values;
  for (std::size_t k = taken; k < count; ++k)
    add_step(*journal, journal->mark(), std::move(steps[k]), values[k], done[k]);
  return values;
}

}  // namespace flank::internal
