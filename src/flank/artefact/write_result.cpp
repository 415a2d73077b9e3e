// The folder that a fit or a cover leaves: every file whole or not at all.
#include <filesystem>

#include "flank/artefact/ranking_json.h"
#include "flank/artefact/strips_step.h"
#include "flank/artefact/verify_json.h"
#include "flank/artefact/view.h"
#include "flank/artefact/view_json.h"
#include "flank/base/atomic_file.h"
#include "flank/error.h"
#include "flank/io/path/path_cls.h"
#include "flank/io/path/path_csv.h"
#include "flank/io/tool/tool_dxf.h"
#include "flank/io/tool/tool_fctb.h"
#include "flank/io/tool/tool_step.h"
#include "flank/job/job_json.h"
#include "flank/path_file.h"
#include "flank/run.h"
#include "flank/tool_file.h"

namespace flank {
using namespace internal;
namespace {

namespace fs = std::filesystem;

/// For CAD and CAM systems. What was left of an earlier tool must not be taken for this one's.
void write_tool_exports(const Tool& tool, const std::string& step, const std::string& fctb) {
  if (check_legitimacy(tool.radial).legitimate) {
    write_file(step, tool_to_step(tool));
    write_file(fctb, tool_to_fctb(tool));
  } else {
    fs::remove(step);
    fs::remove(fctb);
  }
}

std::string part_of(const PlanJob& job) {
  return std::visit([](const auto& plan) { return plan.part.file; }, job);
}

}  // namespace

void ensure_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder))
    throw InputError(folder + ": cannot make this folder (" + (error ? error.message() : "a file is there") +
                     "); a folder that can be written is needed");
  // A probe file that is made and removed.
  const AtomicFile probe((fs::path(folder) / "job.json").string());
}

void write_result(const Result& result, const std::string& folder) {
  ensure_folder(folder);
  const auto file = [&](const char* name) { return (fs::path(folder) / name).string(); };
  ClsOptions cls;
  cls.part = fs::path(part_of(result.job)).stem().string();
  write_file(file("tool.json"), tool_to_json(result.tool));
  write_file(file("tool.dxf"), tool_to_dxf(result.tool));
  write_tool_exports(result.tool, file("tool.step"), file("tool.fctb"));
  if (result.drawings) write_file(file("strips.step"), strips_to_step(result.drawings->strips));
  write_file(file("path.json"), path_to_json(result.path));
  write_file(file("path.cls"), path_to_cls(result.path, result.tool, cls));
  write_file(file("path.csv"), path_to_csv(result.path));
  write_file(file("job.json"), job_to_json(result.job));
  write_file(file("verify.json"), verify_to_json(result.verify, result.acceptance()));
  if (result.drawings) write_file(file("view.json"), view_to_json(result.drawings->view));
  if (result.ranking)
    write_file(file("ranking.json"), ranking_to_json(*result.ranking));
  else
    fs::remove(file("ranking.json"));
  write_file(file("summary.json"), summary_json(result));
}

}  // namespace flank
