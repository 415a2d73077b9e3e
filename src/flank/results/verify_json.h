/// verify.json (docs/schema/verify.md, schema "openflank/verify/1"): a VerifyReport as text and back.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "flank/results/acceptance.h"

namespace flank::internal {

/// "not_run", "pass", "overcut", "gouge" or "unproved".
[[nodiscard]] std::string_view verdict_name(Verdict verdict);
/// "proved" or "sampled".
[[nodiscard]] std::string_view depth_name(DepthProof depth);

/// The figures of a clearance report: "clearance" of verify.json and summary.json.
[[nodiscard]] nlohmann::ordered_json clearance_to_json(const ClearanceReport& report);

/// Which side of a sheet is machined: an entry of "sides" of verify.json, summary.json and view.json.
[[nodiscard]] nlohmann::ordered_json sheet_side_to_json(const SheetSide& side);

/// The report as indented JSON; every number is written so that reading it back gives the same bits. `acceptance` says
/// whether it is what was asked for.
[[nodiscard]] std::string verify_to_json(const VerifyReport& report, const Acceptance& acceptance);

/// The report in `text`, without its acceptance. `source` names the file in messages. Throws InputError for text that is no JSON, another
/// schema, or a field that is missing or of the wrong type.
[[nodiscard]] VerifyReport verify_from_json(const std::string& text, const std::string& source);
/// Its reasons and cautions; one of "verdict" where `pass` is false without any. Throws likewise.
[[nodiscard]] Acceptance acceptance_from_json(const std::string& text, const std::string& source);

/// Adds what the planner of a cavity's cycles found against them, of a summary.json that `source` names in messages: a path alone does
/// not tell what was not planned. Throws as above.
void keep_planned(const std::string& summary, const std::string& source, Acceptance& acceptance);

}  // namespace flank::internal
