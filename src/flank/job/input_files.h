/// What a job reads.
#pragma once

#include <string>
#include <vector>

#include "flank/base/kept/read_files.h"
#include "flank/job.h"
#include "flank/job/field_text.h"
#include "flank/job/fields.h"

namespace flank::internal {

/// use(field, word) for every word of the job that may be the name of a file or folder: part, guide, fixtures, tool, holder,
/// catalogue, machine, program. Any job of the table of fields.
template <class Job, class Use>
void for_each_input(const Job& job, const Use& use) {
  visit_fields(job, [&](const FieldInfo& info, const auto& value) {
    if (info.spelling != Spelling::kFile && info.spelling != Spelling::kFileOrText) return;
    for (const std::string& word : field_words(info, value)) {
      // A plain word is the name of a tool or a machine, though a folder may be called the same.
      const bool plain = info.spelling == Spelling::kFileOrText && word.find_first_of("/.") == std::string::npos;
      if (!word.empty() && !plain) use(info, word);
    }
  });
}

/// These words.
[[nodiscard]] std::vector<std::string> input_files(const PlanJob& job);

/// The files among them, of a folder those in it, with the fields that name them.
template <class Job>
[[nodiscard]] ReadFiles read_files(const Job& job) {
  ReadFiles files;
  for_each_input(
      job, [&](const FieldInfo& info, const std::string& word) { files.add(word, "as `" + field_name(info) + "`"); });
  return files;
}
[[nodiscard]] ReadFiles read_files(const PlanJob& job);

/// SHA-256 of a file; of the files of a folder, such as a catalogue, with their names; empty for words that name neither.
[[nodiscard]] std::string hash_of_input(const std::string& name);

}  // namespace flank::internal
