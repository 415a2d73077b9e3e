// The folder that a fit leaves: every file whole or not at all.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "flank/artefact/strips_step.h"
#include "flank/artefact/verify_json.h"
#include "flank/base/atomic_file.h"
#include "flank/error.h"
#include "flank/io/path/path_cls.h"
#include "flank/io/path/path_csv.h"
#include "flank/io/tool/tool_dxf.h"
#include "flank/io/tool/tool_fctb.h"
#include "flank/io/tool/tool_step.h"
#include "flank/job/job_json.h"
#include "flank/path_file.h"
#include "flank/pipeline/fit_job.h"
#include "flank/tool_file.h"

namespace flank::internal {

void ensure_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    throw InputError("-o " + folder + ": cannot make this folder (" + (error ? error.message() : "a file is there") +
                     "); a folder that can be written is needed");
  // Better to learn it before the work than after: a probe file that is made and removed.
  const AtomicFile probe((std::filesystem::path(folder) / "job.json").string());
}

/// For CAD and CAM systems. What was left of an earlier tool must not be taken for this one's.
static void write_tool_exports(const Tool& tool, const std::string& step, const std::string& fctb) {
  if (check_legitimacy(tool.radial).legitimate) {
    write_file(step, tool_to_step(tool));
    write_file(fctb, tool_to_fctb(tool));
  } else {
    std::filesystem::remove(step);
    std::filesystem::remove(fctb);
  }
}

void write_fit(const FitJob& job, const FitOutcome& outcome, const std::string& folder) {
  ensure_folder(folder);
  const auto file = [&](const char* name) { return (std::filesystem::path(folder) / name).string(); };
  ClsOptions cls;
  cls.part = std::filesystem::path(job.part).stem().string();
  write_file(file("tool.json"), tool_to_json(outcome.tool));
  write_file(file("tool.dxf"), tool_to_dxf(outcome.tool));
  write_tool_exports(outcome.tool, file("tool.step"), file("tool.fctb"));
  write_file(file("strips.step"), strips_to_step(outcome.strip_surfaces));
  write_file(file("path.json"), path_to_json(outcome.path));
  write_file(file("path.cls"), path_to_cls(outcome.path, outcome.tool, cls));
  write_file(file("path.csv"), path_to_csv(outcome.path));
  write_file(file("job.json"), job_to_json(job));
  write_file(file("verify.json"), verify_to_json(outcome.verify, outcome.acceptance(job)));
  write_file(file("view.json"), outcome.view);
  if (outcome.ranking.empty())
    std::filesystem::remove(file("ranking.json"));
  else
    write_file(file("ranking.json"), outcome.ranking);
  write_file(file("summary.json"), summary_json(job, outcome));
}

}  // namespace flank::internal
