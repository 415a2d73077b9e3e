#include "flank/pipeline/run_journal.h"

#include <variant>

#include "flank/base/sha256.h"
#include "flank/job/input_files.h"
#include "flank/job/job_json.h"
#include "flank/tool_request/catalogue.h"
#include "flank/version.h"

namespace flank::internal {
Progress with_journal(const Progress& progress) {
  Progress kept = progress;
  if (!kept.journal) kept.journal = std::make_shared<Journal>();
  return kept;
}

std::vector<InputStamp> input_stamps(const PlanJob& job) {
  std::vector<InputStamp> stamps;
  const auto stamp = [&](const std::string& name) {
    if (std::string hash = hash_of_input(name); !hash.empty()) stamps.push_back({name, std::move(hash)});
  };
  std::visit(
      [&](const auto& plan) {
        for_each_input(plan, [&](const FieldInfo& info, const std::string& word) {
          if (info.key != "part") stamp(word);
        });
        // Where the catalogue is not named, it is the one that is found.
        if constexpr (requires { plan.choice.catalogue; })
          if (plan.tool.spec == "catalogue" && !plan.choice.catalogue) stamp(catalogue_folder({}));
      },
      job);
  return stamps;
}

JournalKey journal_key(const PlanJob& job, const std::string& part_sha256) {
  PlanJob asked = job;
  std::visit([](auto& plan) { plan.part.file.clear(); }, asked);
  std::string all = job_to_json(asked);
  for (const InputStamp& input : input_stamps(asked)) all += input.sha256 + "\n";
  return {kVersion, sha256(all), part_sha256};
}

}  // namespace flank::internal
