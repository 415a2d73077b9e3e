#include "flank/results/write_result.h"

#include <filesystem>
#include <map>
#include <string>

#include "flank/io/mesh/write_mesh.h"
#include "flank/io/path/blank_json.h"
#include "flank/io/path/engagement_json.h"
#include "flank/io/path/path_cls.h"
#include "flank/io/path/path_csv.h"
#include "flank/io/tool/tool_dxf.h"
#include "flank/io/tool/tool_fctb.h"
#include "flank/io/tool/tool_step.h"
#include "flank/job/fields.h"
#include "flank/job/input_files.h"
#include "flank/job/job_json.h"
#include "flank/manifest/journal_json.h"
#include "flank/path_file.h"
#include "flank/results/ranking_json.h"
#include "flank/results/strips_step.h"
#include "flank/results/verify_json.h"
#include "flank/results/view.h"
#include "flank/results/view_json.h"
#include "flank/tool_file.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

std::string part_of(const PlanJob& job) {
  return std::visit([](const auto& plan) { return machined(plan).file; }, job);
}

std::string absolute(const std::string& file) { return fs::absolute(file).lexically_normal().string(); }

Manifest manifest_of(const PlanJob& job, const std::string& part_sha256, const ResultFolder& folder) {
  Manifest manifest;
  manifest.made_by = std::visit([](const auto& plan) { return std::string(command_name(plan)); }, job);
  manifest.folder = absolute(folder.path());
  manifest.part = {absolute(part_of(job)), part_sha256};
  manifest.judged = manifest.part;
  return manifest;
}

}  // namespace

FileTexts result_files(const Result& result, const Acceptance& acceptance) {
  FileTexts files;
  ClsOptions cls;
  cls.part = fs::path(part_of(result.job)).stem().string();
  files["tool.json"] = tool_to_json(result.tool);
  files["tool.dxf"] = tool_to_dxf(result.tool);
  // For CAD and CAM systems: only what can be made.
  if (check_legitimacy(result.tool.radial).legitimate) {
    files["tool.step"] = tool_to_step(result.tool);
    files["tool.fctb"] = tool_to_fctb(result.tool);
  }
  if (result.drawings) files["strips.step"] = strips_to_step(result.drawings->strips, result.tool.radial.axis_length());
  files["path.json"] = [&result] { return path_to_json(result.path); };
  files["path.cls"] = [&result, cls] { return path_to_cls(result.path, result.tool, cls); };
  files["path.csv"] = [&result] { return path_to_csv(result.path); };
  files["job.json"] = job_to_json(result.job);
  files["verify.json"] = verify_to_json(result.verify, acceptance);
  if (result.drawings) files["view.json"] = [&result] { return view_to_json(result.drawings->view); };
  if (result.drawings && !result.drawings->blank.empty()) files["blank.json"] = blank_to_json(result.drawings->blank);
  if (result.drawings && !result.drawings->engagement.empty())
    files["engagement.json"] = [&result] {
      return engagement_to_json(result.drawings->engagement, result.drawings->arcs);
    };
  if (result.drawings && !result.drawings->left.triangles.empty())
    files["stock.stl"] = mesh_to_stl(result.drawings->left);
  if (result.ranking) files["ranking.json"] = ranking_to_json(*result.ranking);
  if (!result.complete && result.journal && result.journal->key())
    files[kJournalFile] = journal_to_json(*result.journal);
  files["summary.json"] = summary_json(result, acceptance);
  return files;
}

Manifest result_manifest(const Result& result, const ResultFolder& folder) {
  Manifest manifest = manifest_of(result.job, result.part_sha256, folder);
  for (const InputStamp& input : result.inputs) manifest.inputs.push_back({absolute(input.file), input.sha256});
  return manifest;
}

void write_result(const Result& result, ResultFolder& folder) {
  folder.replace(result_files(result, result.acceptance()), result_manifest(result, folder));
}

bool write_steps(const Progress::Journal& journal, const PlanJob& job, ResultFolder& folder) {
  if (!journal.key() || journal.steps().empty()) return false;
  const FileTexts files{{kJournalFile, journal_to_json(journal)}};
  if (!folder.manifest())
    folder.replace(files, manifest_of(job, journal.key()->part, folder));
  else if (folder.manifest()->files.contains(kJournalFile))
    folder.add(files, *folder.manifest());
  else
    return false;
  return true;
}

}  // namespace flank::internal

namespace flank {

void write_result(const Result& result, const std::string& folder) {
  const internal::ReadFiles inputs = internal::read_files(result.job);
  const internal::Unwritten unwritten(inputs);
  internal::ResultFolder held(folder, internal::ResultFolder::Use::kWrite);
  held.require_not_inputs(inputs);
  internal::write_result(result, held);
}

}  // namespace flank
