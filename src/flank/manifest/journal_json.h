/// resume.json (docs/schema/resume.md): the finished steps of a run that was stopped.
#pragma once

#include <string>
#include <string_view>

#include "flank/base/journal.h"

namespace flank::internal {

inline constexpr const char* kJournalFile = "resume.json";

/// All numbers with the digits that read back as the same double. The journal has a key.
[[nodiscard]] std::string journal_to_json(const Journal& journal);

/// Throws InputError naming the file and the step: no JSON, another schema, a key that is missing or not known, a value of
/// the wrong type, a number that is none. What the numbers of a step mean is checked when the step is taken.
[[nodiscard]] Journal journal_from_json(std::string_view text, const std::string& file);

}  // namespace flank::internal
