#include "flank/base/journal.h"

#include <cstring>
#include <string_view>

#include "flank/base/sha256.h"
#include "flank/error.h"

namespace flank {

void Progress::Journal::begin(const JournalKey& key) {
  if (begun_) return;
  if (key_ && *key_ != key) {
    const std::string needed = "; give a folder of the same command, part, options and version";
    if (key_->part != key.part) throw InputError(file_ + ": is of another part" + needed);
    if (key_->version != key.version)
      throw InputError(file_ + ": is of version " + key_->version + ", and this is " + key.version + needed);
    throw InputError(file_ + ": is of another job" + needed);
  }
  key_ = key;
  begun_ = true;
}

bool Progress::Journal::is_next(const JournalStep& step) const {
  return taken_ < earlier_.size() && earlier_[taken_].name == step.name && earlier_[taken_].inputs == step.inputs;
}

void Progress::Journal::refuse(const std::string& why) const {
  throw InputError(file_ + ": step " + std::to_string(taken_ + 1) + " (" + earlier_[taken_].name + "): " + why);
}

void Progress::Journal::add(std::size_t mark, JournalStep step) {
  steps_.resize(mark);
  steps_.push_back(std::move(step));
  added_ = true;
}

std::vector<internal::JournalStep> Progress::Journal::steps() const {
  std::vector<JournalStep> all = steps_;
  if (!added_) all.insert(all.end(), earlier_.begin() + static_cast<std::ptrdiff_t>(taken_), earlier_.end());
  return all;
}

}  // namespace flank

namespace flank::internal {

std::string fingerprint(const StepValues& values) {
  std::string bytes(values.numbers.size() * sizeof(double), '\0');
  if (!values.numbers.empty()) std::memcpy(bytes.data(), values.numbers.data(), bytes.size());
  // Each with its length, so that no two lists of texts are alike.
  for (const std::string& text : values.texts) bytes += std::to_string(text.size()) + ":" + text;
  return sha256(bytes);
}

}  // namespace flank::internal
