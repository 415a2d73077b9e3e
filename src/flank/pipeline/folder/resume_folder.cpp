#include "flank/pipeline/folder/resume_folder.h"

#include <filesystem>
#include <variant>

#include "flank/base/sha256.h"
#include "flank/error.h"
#include "flank/io/text/json_input.h"
#include "flank/job/job_json.h"
#include "flank/manifest/journal_json.h"
#include "flank/run.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

std::string in(const ResultFolder& folder, const char* name) { return (fs::path(folder.path()) / name).string(); }

bool has(const ResultFolder& folder, const char* name) {
  return folder.manifest() && folder.manifest()->files.contains(name) && fs::is_regular_file(in(folder, name));
}

bool is_complete(const ResultFolder& folder) {
  if (has(folder, kJournalFile) || !has(folder, "summary.json") || !has(folder, "job.json")) return false;
  const std::string file = in(folder, "summary.json");
  const auto summary = nlohmann::json::parse(read_file(file), nullptr, false);
  return summary.is_object() && summary.value("complete", nlohmann::json()) == true;
}

/// As job.json has it, to be compared: with the ball to reach with and the shank that the run has chosen and written there.
PlanJob as_written(const PlanJob& job, const PlanJob& written) {
  PlanJob asked = job_from_json(job_to_json(job), "job.json");
  std::visit(
      [](auto& plan, const auto& made) {
        ObstacleRequest& own = plan.obstacles;
        if (!plan.judge.reach_radius_mm) plan.judge.reach_radius_mm = made.judge.reach_radius_mm;
        if (!own.shank_length_mm && !own.holder && own.shank != "none") {
          own.shank_radius_mm = own.shank_radius_mm ? own.shank_radius_mm : made.obstacles.shank_radius_mm;
          own.shank_length_mm = made.obstacles.shank_length_mm;
          own.shank = made.obstacles.shank;
        }
        plan.part.file.clear();  // the part is known by its bytes
      },
      asked, written);
  return asked;
}

std::string part_hash(const PlanJob& job) {
  return sha256(read_file(std::visit([](const auto& plan) { return plan.part.file; }, job)));
}

constexpr const char* kToGoOn =
    "; to resume, give the part, files and options of that folder; to start again, leave out --resume";

/// The tool, the holder, the fixtures and whatever else the job reads: the names may be others, the bytes may not.
void require_same_inputs(const ResultFolder& folder, const std::vector<InputStamp>& inputs) {
  const std::vector<PartStamp>& made = folder.manifest()->inputs;
  for (std::size_t k = 0; k < inputs.size(); ++k)
    if (k >= made.size() || made[k].sha256 != inputs[k].sha256)
      throw InputError(inputs[k].file + ": " +
                       (k >= made.size() ? std::string("is not named by ") + kManifestFile + " of "
                                         : std::string("has changed since, or is another one than that of ")) +
                       "the complete result in " + folder.path() + kToGoOn);
  if (made.size() > inputs.size())
    throw InputError(made[inputs.size()].file + ": was read for the complete result in " + folder.path() +
                     ", and is gone" + kToGoOn);
}

void require_unchanged(const ResultFolder& folder) {
  std::vector<std::string> names;
  for (const auto& [name, hash] : folder.manifest()->files)
    if (name != kPageFile) names.push_back(name);
  folder.require_there(names);
  folder.require_whole();
}

bool passes(const std::string& file) {
  const auto json = nlohmann::json::parse(read_file(file), nullptr, false);
  return json.is_object() && json.value("pass", nlohmann::json()) == true;
}

}  // namespace

bool is_finished(const ResultFolder& folder, const PlanJob& job, const std::vector<InputStamp>& inputs) {
  if (!is_complete(folder)) return false;
  const std::string file = in(folder, "job.json");
  PlanJob made = job_from_json(read_file(file), file);
  std::visit([](auto& plan) { plan.part.file.clear(); }, made);
  if (as_written(job, made) != made)
    throw InputError(folder.path() + ": holds the complete result of another job" + kToGoOn);
  if (folder.manifest()->part.sha256 != part_hash(job))
    throw InputError(folder.path() + ": holds the complete result of another part" + kToGoOn);
  require_same_inputs(folder, inputs);
  require_unchanged(folder);
  return true;
}

bool meets_request(const ResultFolder& folder) {
  return passes(in(folder, "summary.json")) && passes(in(folder, "verify.json"));
}

std::shared_ptr<Journal> journal_of(const ResultFolder& folder) {
  if (!has(folder, kJournalFile))
    throw InputError(folder.path() + ": nothing to resume (no " + kJournalFile +
                     " of a stopped run); give the folder of one, or leave out --resume");
  const std::string file = in(folder, kJournalFile), text = read_file(file);
  if (sha256(text) != folder.manifest()->files.at(kJournalFile))
    throw InputError(file + ": is not the file that " + kManifestFile +
                     " names: it was changed; leave out --resume to start again");
  return std::make_shared<Journal>(journal_from_json(text, file));
}

}  // namespace flank::internal

namespace flank {

std::shared_ptr<Progress::Journal> read_journal(const std::string& folder) {
  return internal::journal_of(internal::ResultFolder(folder, internal::ResultFolder::Use::kRead));
}

}  // namespace flank
