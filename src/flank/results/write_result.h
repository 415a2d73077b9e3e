/// A result into a folder that is held already (run.h has the same for a folder by its name).
#pragma once

#include <string>

#include "flank/base/journal.h"
#include "flank/manifest/result_folder.h"
#include "flank/run.h"

namespace flank::internal {

/// The files of a result, name and content, with this verdict in all that say one: Result::acceptance, but for tests of who
/// reads them.
[[nodiscard]] FileTexts result_files(const Result& result, const Acceptance& acceptance);
/// The manifest that belongs to them.
[[nodiscard]] Manifest result_manifest(const Result& result, const ResultFolder& folder);
/// summary.json of them.
[[nodiscard]] std::string summary_json(const Result& result, const Acceptance& acceptance);

/// All files of run.h's write_result and their manifest, in the place of what was there. Throws InputError; what was
/// there is whole then.
void write_result(const Result& result, ResultFolder& folder);

/// Of a run that was stopped before it had a result: its finished steps, as resume.json. False, and nothing is written, if
/// there are none, or if the folder holds a result that is complete, which stays. Throws InputError.
[[nodiscard]] bool write_steps(const Progress::Journal& journal, const PlanJob& job, ResultFolder& folder);

}  // namespace flank::internal
